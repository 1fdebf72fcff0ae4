// SPDX-License-Identifier: BSD-3-Clause
#include "loop/pose_pipeline.hpp"

namespace ardrone_vslam {

PosePipeline::PosePipeline(const TrackerConfig& tracker, const SlamConfig& slam,
                           const CameraIntrinsics& camera, const Eigen::Isometry3d& T_base_cam)
    : config_(slam),
      T_base_cam_(T_base_cam),
      tracker_(tracker, camera),
      observer_(slam),
      setup_(slam.image_time_offset_s) {
  setup_.useCamera(T_base_cam);
  slam_.emplace(config_, T_base_cam_);
  slam_->reserveMap();
  features_.reserve(static_cast<std::size_t>(tracker.corners.features_per_frame));
}

void PosePipeline::beginAnew() {
  result_ = nullptr;
  slam_.emplace(config_, T_base_cam_);
  slam_->reserveMap();
  ++restarts_;
}

void PosePipeline::startOver() {
  is_waiting_ = false;
  observer_.clear();
  beginAnew();
}

bool PosePipeline::track(const Frame& frame) {
  const bool is_ascending = newest_ns_ == 0 || frame.stamp_ns > newest_ns_;
  if (!is_ascending && frame.stamp_ns > newest_ns_ - ObserverStates::kRestart_ns) return false;
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

PosePipeline::Answer PosePipeline::localise() {
  using Lookup = OdometryBuffer::Lookup;
  OdometryState state;
  const Lookup lookup =
      observer_.at(setup_.clock().exposed_ns(features_.stamp_ns), features_.stamp_ns, state);
  const bool may_come = lookup == Lookup::kNotYet || lookup == Lookup::kEmpty;
  if (may_come && !observer_.isOver()) return Answer::kNotYet;
  is_waiting_ = false;
  if (lookup != Lookup::kFound) return Answer::kNever;
  setup_.see(features_, observer_.buffer(), *slam_);
  result_ = &slam_->process(features_, state);
  return Answer::kPose;
}

}  // namespace ardrone_vslam
