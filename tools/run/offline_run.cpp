// SPDX-License-Identifier: BSD-3-Clause
#include "run/offline_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "ardrone_vslam/image_roll.hpp"

namespace ardrone_vslam {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

ImageView viewOf(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

/// The image's turn at ascending stamps, from odometry.
class ImageRolls {
 public:
  explicit ImageRolls(const FrontEndAttitude& attitude)
      : attitude_(attitude.states != nullptr ? *attitude.states : kNone),
        image_time_offset_ns_(std::llround(attitude.image_time_offset_s * 1e9)) {}

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

}  // namespace

double total_ms(const StageTimes_ms& times_ms) {
  return std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
}

StageTimer::StageTimer(StageTimes_ms& times_ms) : times_ms_(times_ms) {}

StageHook StageTimer::hook() {
  return [this](Stage stage) { enter(stage); };
}

void StageTimer::enter(Stage stage) {
  const std::int64_t now = now_ns();
  if (stage_ != Stage::kIdle)
    times_ms_[static_cast<std::size_t>(stage_)] += static_cast<double>(now - since_ns_) * 1e-6;
  stage_ = stage;
  since_ns_ = now;
}

void runFrontEnd(Sequence& sequence, const TrackerConfig& config, const FrontEndAttitude& attitude,
                 int threads, const std::function<void(const TrackedFrame& frame)>& consume,
                 const NextImage& next_image) {
  std::optional<Tracker> tracker;
  std::size_t which = 0;
  SequenceCamera camera;
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
    frame.other_camera.reset();
    if (!tracker || sequence.cameraOf(i) != which) {
      which = sequence.cameraOf(i);
      camera = sequence.cameraAt(which);
      if (tracker) frame.other_camera = camera.T_base_cam;
      const std::uint32_t first_track_id = tracker ? tracker->nextTrackId() : 1;
      tracker.emplace(config, camera.intrinsics, first_track_id);
    }
    frame.times_ms = {};
    StageTimer timer(frame.times_ms);
    tracker->process(viewOf(image), sequence.stamp_ns(i), frame.features, timer.hook(),
                     turns.at(sequence.stamp_ns(i), camera.T_base_cam.linear()));
    consume(frame);
    const std::size_t decoded = i + 1;
    i = next_image ? next_image(i) : decoded;
    if (i != decoded && i < sequence.size()) {
      next = {};  // a sequence gives one image at a time
      next = load(i);
    }
  }
}

BackEnd::BackEnd(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam,
                 const std::vector<OdometryState>& odometry, std::vector<RangeReading> ranges)
    : slam_(config, T_base_cam),
      T_base_cam_(T_base_cam),
      image_time_offset_ns_(std::llround(config.image_time_offset_s * 1e9)),
      time_offset_(T_base_cam, config.image_time_offset_s),
      setup_(T_base_cam, config.image_time_offset_s),
      odometry_(config, odometry),
      heights_(config, std::move(ranges)) {
  run_.image_time_offset_s = config.image_time_offset_s;
}

void BackEnd::changeCamera(const Eigen::Isometry3d& T_base_cam) {
  if (!slam_.canChangeCamera())
    throw std::runtime_error(
        "the images are of several cameras, and extrinsics_sigma_deg is of one: set it to 0");
  slam_.changeCamera(T_base_cam);
  T_base_cam_ = T_base_cam;
  time_offset_.useCamera(T_base_cam);
  setup_.useCamera(T_base_cam);
  watch_.reset();
  standstill_.reset();
  ++run_.camera_changes;
}

double BackEnd::process(const TrackedFrame& frame) {
  if (frame.other_camera) changeCamera(*frame.other_camera);
  OdometryState state;
  if (!odometry_.at(frame.features.stamp_ns + image_time_offset_ns_, state)) {
    ++run_.frames_without_odometry;
    return total_ms(frame.times_ms);
  }
  watch_.see(frame.features, Eigen::Isometry3d((state.T_odom_base * T_base_cam_).linear()));
  standstill_.see(frame.features, state.T_odom_base * T_base_cam_);
  run_.odometry_froze = run_.odometry_froze || standstill_.isStuck();
  state.height_m = heights_.at(state);
  state.stamp_ns = frame.features.stamp_ns;  // the pose keeps the image's stamp
  time_offset_.see(frame.features, odometry_.buffer());
  watchSetup(frame.features);
  RunFrame run_frame;
  run_frame.times_ms = frame.times_ms;
  StageTimer timer(run_frame.times_ms);
  run_frame.result = slam_.process(frame.features, state, timer.hook());
  run_.frames.push_back(std::move(run_frame));
  return total_ms(run_.frames.back().times_ms);
}

void BackEnd::watchSetup(const ImageFeatures& features) {
  setup_.see(features, odometry_.buffer());
  const SetupFinding& found = setup_.finding();
  slam_.heed(found);
  const bool is_fault = found.fault != SetupFault::kNone;
  if (is_fault || run_.setup.fault == SetupFault::kNone) run_.setup = found;
  if (is_fault && run_.setup_fault_ns == 0) run_.setup_fault_ns = features.stamp_ns;
}

RunResult BackEnd::finish() {
  run_.time_offset = time_offset_.estimate();
  run_.images_travel = watch_.isStuck();
  run_.absurd_speed_m_s = odometry_.absurdSpeed_m_s();
  run_.odometry_states_refused = odometry_.refused();
  run_.odometry_faults = odometry_.faults();
  run_.ranges_refused = heights_.input().refused();
  run_.heights_missing = heights_.input().missing();
  run_.heights_tilted = heights_.input().tilted();
  run_.landmarks = slam_.landmarks();
  return std::move(run_);
}

std::int64_t countDistrusted(const RunResult& run) {
  return std::count_if(run.frames.begin(), run.frames.end(), [](const RunFrame& frame) {
    return frame.result.state == SlamState::kDistrusted;
  });
}

}  // namespace ardrone_vslam
