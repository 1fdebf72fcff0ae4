// SPDX-License-Identifier: BSD-3-Clause
#include "run/front_end.hpp"

#include <cmath>
#include <cstdint>
#include <future>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/rotation.hpp"
#include "ardrone_vslam/tracker.hpp"

namespace ardrone_vslam {
namespace {

ImageView viewOf(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

/// The image's turn at ascending stamps, from odometry.
class ImageRolls {
 public:
  explicit ImageRolls(const FrontEndAttitude& attitude)
      : attitude_(attitude.states != nullptr ? *attitude.states : kNone),
        image_time_offset_ns_(std::llround(attitude.image_time_offset_s.value_or(0) * 1e9)) {}

  std::optional<float> at(std::int64_t stamp_ns, const Eigen::Matrix3d& R_base_cam) {
    const std::int64_t exposed_ns = stamp_ns + image_time_offset_ns_;
    while (next_ < attitude_.size() && attitude_[next_].stamp_ns < exposed_ns) ++next_;
    if (next_ == attitude_.size()) return std::nullopt;
    const OdometryState& after = attitude_[next_];
    if (next_ == 0 && after.stamp_ns > exposed_ns) return std::nullopt;
    const OdometryState& before = attitude_[next_ == 0 ? 0 : next_ - 1];
    const OdometryState state =
        after.stamp_ns == exposed_ns ? after : interpolate(before, after, exposed_ns);
    return imageRoll_rad(state.T_odom_base.linear() * R_base_cam);
  }

 private:
  inline static const std::vector<OdometryState> kNone;

  const std::vector<OdometryState>& attitude_;
  std::int64_t image_time_offset_ns_;
  std::size_t next_ = 0;
};

/// The tracker of the camera whose turn it is.
class CameraTracker {
 public:
  CameraTracker(const Sequence& sequence, const TrackerConfig& config)
      : sequence_(sequence), config_(config) {}

  /// Before an image. @return the camera's mounting where it is another one than before
  std::optional<Eigen::Isometry3d> use(std::size_t image) {
    if (tracker_ && sequence_.cameraOf(image) == which_) return std::nullopt;
    which_ = sequence_.cameraOf(image);
    const SequenceCamera camera = sequence_.cameraAt(which_);
    R_base_cam_ = camera.T_base_cam.linear();
    const bool is_first = !tracker_;
    const std::uint32_t first_track_id = is_first ? 1 : tracker_->nextTrackId();
    tracker_.emplace(config_, camera.intrinsics, first_track_id);
    return is_first ? std::nullopt : std::optional<Eigen::Isometry3d>(camera.T_base_cam);
  }
  Tracker& tracker() { return *tracker_; }
  const Eigen::Matrix3d& R_base_cam() const { return R_base_cam_; }

 private:
  const Sequence& sequence_;
  const TrackerConfig& config_;
  std::optional<Tracker> tracker_;
  std::size_t which_ = 0;
  Eigen::Matrix3d R_base_cam_ = Eigen::Matrix3d::Identity();
};

}  // namespace

void runFrontEnd(Sequence& sequence, const TrackerConfig& config, const FrontEndAttitude& attitude,
                 int threads, const std::function<void(const TrackedFrame& frame)>& consume,
                 const NextImage& next_image) {
  CameraTracker camera(sequence, config);
  const auto policy = threads >= 2 ? std::launch::async : std::launch::deferred;
  const auto load = [&sequence, policy](std::size_t index) {
    return std::async(policy, [&sequence, index] { return sequence.image(index); });
  };
  ImageRolls turns(attitude);
  TrackedFrame frame;
  std::future<cv::Mat> next;
  if (sequence.size() > 0) next = load(0);
  for (std::size_t i = 0; i < sequence.size();) {
    const cv::Mat image = next.get();
    if (i + 1 < sequence.size()) next = load(i + 1);
    frame.other_camera = camera.use(i);
    frame.times_ms = {};
    StageTimer timer(frame.times_ms);
    camera.tracker().process(viewOf(image), sequence.stamp_ns(i), frame.features, timer.hook(),
                             turns.at(sequence.stamp_ns(i), camera.R_base_cam()));
    consume(frame);
    const std::size_t decoded = i + 1;
    i = next_image ? next_image(i) : decoded;
    if (i != decoded && i < sequence.size()) {
      next = {};  // a sequence gives one image at a time
      next = load(i);
    }
  }
}

}  // namespace ardrone_vslam
