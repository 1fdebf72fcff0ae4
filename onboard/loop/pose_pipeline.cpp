// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_pipeline.hpp"

#include <cmath>

namespace ardrone_vslam {
namespace {

/// As the nodelets' StampGuard: a stamp so far back is a clock that was set.
constexpr std::int64_t kRestart_ns = 1'000'000'000;

}  // namespace

PosePipeline::PosePipeline(const TrackerConfig& tracker, const SlamConfig& slam,
                           const CameraIntrinsics& camera, const Eigen::Isometry3d& T_base_cam)
    : config_(slam),
      T_base_cam_(T_base_cam),
      image_time_offset_ns_(std::llround(slam.image_time_offset_s * 1e9)),
      tracker_(tracker, camera),
      adapter_(slam.odometry_adapter),
      buffer_(slam.odometry),
      setup_(T_base_cam, slam.image_time_offset_s),
      heights_(slam.height_input, slam.odometry.buffer_s) {
  slam_.emplace(config_, T_base_cam_);
  slam_->reserveMap();
  features_.reserve(static_cast<std::size_t>(tracker.corners.features_per_frame));
  ready_.reserve(64);
}

void PosePipeline::beginAnew() {
  result_ = nullptr;
  slam_.emplace(config_, T_base_cam_);
  slam_->reserveMap();
  ++restarts_;
}

void PosePipeline::startOver() {
  is_waiting_ = false;
  buffer_.clear();
  heights_.clear();
  beginAnew();
}

bool PosePipeline::track(const Frame& frame) {
  const bool is_ascending = newest_ns_ == 0 || frame.stamp_ns > newest_ns_;
  if (!is_ascending && frame.stamp_ns > newest_ns_ - kRestart_ns) return false;
  if (!is_ascending) {
    startOver();
  } else if (result_ != nullptr && result_->state == SlamState::kNotFinite) {
    beginAnew();
  }
  newest_ns_ = frame.stamp_ns;
  tracker_.process(frame.image, frame.stamp_ns, features_);
  is_waiting_ = true;
  return true;
}

bool PosePipeline::take(OdometryBuffer::Push answer) {
  bool is_good = answer == OdometryBuffer::Push::kAccepted;
  for (const OdometryState& state : ready_)
    is_good = buffer_.push(state) == OdometryBuffer::Push::kAccepted && is_good;
  return is_good;
}

bool PosePipeline::addOdometry(const OdometryState& message) {
  if (message.stamp_ns <= buffer_.newestStamp_ns() - kRestart_ns) {  // its clock was set
    buffer_.clear();
    heights_.clear();
  }
  if (message.height_m) {
    RangeReading reading;
    reading.stamp_ns = message.stamp_ns;
    reading.range_m = *message.height_m;
    reading.max_m = kFarthestOdometry_m;
    reading.is_vertical = true;
    heights_.push(reading);
  }
  ready_.clear();
  return take(adapter_.push(message, ready_));
}

void PosePipeline::endObserver() {
  ready_.clear();
  take(adapter_.flush(ready_));
  is_odometry_over_ = true;
}

PosePipeline::Answer PosePipeline::localise() {
  using Lookup = OdometryBuffer::Lookup;
  OdometryState state;
  const Lookup lookup = buffer_.at(features_.stamp_ns + image_time_offset_ns_, state);
  const bool may_come = lookup == Lookup::kNotYet || lookup == Lookup::kEmpty;
  if (may_come && !is_odometry_over_) return Answer::kNotYet;
  is_waiting_ = false;
  if (lookup != Lookup::kFound) return Answer::kNever;
  state.height_m = heights_.at(state);
  state.stamp_ns = features_.stamp_ns;  // the pose keeps the image's stamp
  setup_.see(features_, buffer_);
  slam_->heed(setup_.finding());
  result_ = &slam_->process(features_, state);
  return Answer::kPose;
}

}  // namespace ardrone_vslam
