// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/tracker.hpp"

#include <algorithm>
#include <cassert>

#include "alignment/patch_aligner.hpp"
#include "ardrone_vslam/frame_tracker.hpp"
#include "corners/corner_detector.hpp"
#include "freak/freak.hpp"

namespace ardrone_vslam {
namespace {

/// Cut off on each side, so that the detector, which cannot test the outermost pixels of what it is
/// given, tests those that FREAK can describe: the corner budget, its cells and their thresholds
/// are not spent on others.
constexpr int kCut_px = kFreakBorder_px - CornerDetector::kBorder_px;

/// @return without pixels if the image has none to describe
ImageView describablePart(const ImageView& image) {
  if (std::min(image.width_px, image.height_px) <= 2 * kCut_px) return {};
  ImageView part = image;
  part.data += kCut_px * image.stride_bytes + kCut_px;
  part.width_px -= 2 * kCut_px;
  part.height_px -= 2 * kCut_px;
  return part;
}

}  // namespace

struct Tracker::State {
  State(const TrackerConfig& config, const CameraIntrinsics& intrinsics,
        std::uint32_t first_track_id)
      : camera(intrinsics, config.undistort),
        detector(config.corners),
        describer(config.freak),
        frame_tracker(config.tracks, first_track_id),
        aligner(camera),
        align_tracks(config.align_tracks),
        use_attitude(config.use_attitude) {}

  CameraModel camera;
  CornerDetector detector;
  FreakDescriber describer;
  FrameTracker frame_tracker;
  PatchAligner aligner;
  bool align_tracks;
  bool use_attitude;

  std::vector<Corner> corners;            // in the describable part of the image
  std::vector<Eigen::Vector3f> bearings;  // of the keypoints
  std::vector<std::uint8_t> scores;       // of the keypoints
  std::vector<FreakKeypoint> keypoints;   // corners that have a bearing
  std::vector<int> described;             // indices into keypoints

  void reserve(std::size_t budget);
  void keepCornersWithBearing();
  void collect(const ImageView& image, std::int64_t stamp_ns, ImageFeatures& features) const;
};

Tracker::Tracker(const TrackerConfig& config, const CameraIntrinsics& camera,
                 std::uint32_t first_track_id) {
  validate(config);
  state_ = std::make_unique<State>(config, camera, first_track_id);
  state_->reserve(static_cast<std::size_t>(config.corners.features_per_frame));
}

/// Room for the whole budget, so that a rich image after dull ones allocates nothing.
void Tracker::State::reserve(std::size_t budget) {
  const int width_px = camera.intrinsics().width_px;
  const int height_px = camera.intrinsics().height_px;
  bearings.reserve(budget);
  scores.reserve(budget);
  frame_tracker.reserve(budget, width_px, height_px);
  aligner.reserve(budget);
  // The describer's own buffers grow with what it is given: as much as it will ever be.
  const std::vector<std::uint8_t> black(static_cast<std::size_t>(width_px) *
                                        static_cast<std::size_t>(height_px));
  std::vector<Descriptor> descriptors;
  keypoints.assign(budget, {width_px / 2, height_px / 2});
  described.reserve(budget);
  describer.describe({black.data(), width_px, height_px, width_px}, keypoints, described,
                     descriptors);
}

Tracker::~Tracker() = default;

const CameraModel& Tracker::camera() const {
  return state_->camera;
}

std::uint32_t Tracker::nextTrackId() const {
  return state_->frame_tracker.nextTrackId();
}

void Tracker::process(const ImageView& image, std::int64_t stamp_ns, ImageFeatures& features,
                      const StageHook& hook, std::optional<float> image_roll_rad) {
  State& s = *state_;
  assert(image.width_px == s.camera.intrinsics().width_px &&
         image.height_px == s.camera.intrinsics().height_px &&
         "the image is not as large as the calibration says");
  const auto enter = [&hook](Stage stage) {
    if (hook) hook(stage);
  };
  features.clear();
  features.reserve(s.keypoints.capacity());  // the corner budget

  enter(Stage::kDetect);
  s.detector.detect(describablePart(image), s.corners);
  s.keepCornersWithBearing();

  enter(Stage::kDescribe);
  s.describer.describe(image, s.keypoints, s.described, features.descriptor, nullptr,
                       s.use_attitude ? image_roll_rad : std::nullopt);
  s.collect(image, stamp_ns, features);

  enter(Stage::kTrack);
  const std::vector<int>& previous_of = s.frame_tracker.assign(features);
  if (s.align_tracks) s.aligner.align(image, previous_of, features);
  enter(Stage::kIdle);
}

void Tracker::State::keepCornersWithBearing() {
  keypoints.clear();
  bearings.clear();
  scores.clear();
  for (const Corner& corner : corners) {
    const int x_px = corner.x_px + kCut_px;
    const int y_px = corner.y_px + kCut_px;
    const auto bearing = camera.bearing({x_px, y_px});
    if (!bearing) continue;
    keypoints.push_back({x_px, y_px});
    bearings.push_back(bearing->cast<float>());
    scores.push_back(corner.score);
  }
}

void Tracker::State::collect(const ImageView& image, std::int64_t stamp_ns,
                             ImageFeatures& features) const {
  features.stamp_ns = stamp_ns;
  features.width_px = image.width_px;
  features.height_px = image.height_px;
  features.focal_length_px = static_cast<float>(camera.focalLength_px());
  for (const int index : described) {
    const auto i = static_cast<std::size_t>(index);
    features.pixel_px.emplace_back(static_cast<float>(keypoints[i].x_px),
                                   static_cast<float>(keypoints[i].y_px));
    features.bearing_cam.push_back(bearings[i]);
    features.score.push_back(scores[i]);
  }
}

}  // namespace ardrone_vslam
