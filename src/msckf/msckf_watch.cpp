// SPDX-License-Identifier: BSD-3-Clause
// What the MSCKF does when camera and odometry contradict each other.
#include "msckf/msckf.hpp"

namespace ardrone_vslam {

void Msckf::watchForContradiction() {
  Contradiction contradiction;
  contradiction.bias_sigmas = state_.biasSigmas();
  if (fix_was_compared_) contradiction.fix_nis = fixNis();
  contradiction.is_confirmed = fix_outcome_ == FixOutcome::kApplied ||
                               fix_outcome_ == FixOutcome::kRelocated ||
                               fix_outcome_ == FixOutcome::kNotNeeded;
  fix_was_compared_ = false;
  if (watchdog_.see(newest().stamp_ns, contradiction)) forgetCamera();
  if (watchdog_.isCalm()) trusted_T_map_odom_ = state_.T_map_odom();
}

void Msckf::forgetCamera() {
  tracks_ = TrackWindow(R_base_cam_);
  earlier_camera_.reset();
  consistency_ = {};
  rest_ = ZeroMotionDetector(config_.rest);
  reference_id_ = 0;
  reference_is_keyframe_ = false;
  keyframe_id_ = 0;
  // Landmarks keep their anchors: they may be right, and show it later.
  while (state_.frames().size() > 1) dropOldest();
  state_.returnTo(trusted_T_map_odom_);
}

}  // namespace ardrone_vslam
