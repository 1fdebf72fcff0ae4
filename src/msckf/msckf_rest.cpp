// SPDX-License-Identifier: BSD-3-Clause
// What the MSCKF does when the image is still.
#include <cmath>

#include "msckf/msckf.hpp"

namespace ardrone_vslam {

void Msckf::watchForRest(const ImageFeatures& features) {
  const auto reference = frameOf(reference_id_);
  Eigen::Matrix3d R_reference_now = Eigen::Matrix3d::Identity();
  double attitude_sigma_rad = 0;
  if (!reference) rest_ = ZeroMotionDetector(config_.rest);
  if (reference && reference_id_ != newest().id) {
    attitude_sigma_rad = rotationSigma_rad(*reference);
    R_reference_now = (state_.frames()[*reference].R_map_rig * R_base_cam_).transpose() *
                      newest().R_map_rig * R_base_cam_;
  }
  motion_ = rest_.see(features, R_reference_now, attitude_sigma_rad);
  const bool is_still = motion_ == CameraMotion::kResting || motion_ == CameraMotion::kRotating;
  if (is_still && reference && !isLocated() && !holdStill(*reference))
    motion_ = CameraMotion::kMoving;
  if (!is_still) odometry_displacement_.setZero();
  if (rest_.isReference()) makeReference();
}

double Msckf::rotationSigma_rad(std::size_t frame) const {
  // Taken as exact or not, the attitude is noisy.
  if (!config_.attitude_states)
    return std::sqrt(2.0) * config_.odometry.attitude_noise_deg * M_PI / 180;
  const Matrix6d relative = state_.relativeCovariance(
      state_.frameCoordinate(frame), state_.frameCoordinate(state_.frames().size() - 1));
  return std::sqrt(relative.bottomRightCorner<3, 3>().trace() / 3);
}

bool Msckf::isLocated() const {
  return fix_outcome_ == FixOutcome::kApplied || fix_outcome_ == FixOutcome::kRelocated ||
         fix_outcome_ == FixOutcome::kNotNeeded;
}

bool Msckf::holdStill(std::size_t reference) {
  // Odometry does not err by so much: the image stands still for another reason (a frozen stream).
  constexpr double kFastest_m_s = 0.5;
  constexpr double kSlack_m = 0.1;
  const Clone& then = state_.frames()[reference];
  odometry_displacement_ += newest().position_map + newest().R_map_rig * camera_base_ -
                            then.position_map - then.R_map_rig * camera_base_;
  if (odometry_displacement_.norm() > kFastest_m_s * rest_.still_s() + kSlack_m) return false;
  const double depth_m = point_distance_m_ > 0 ? point_distance_m_ : config_.rest.rest_depth_m;
  const Eigen::Matrix3d R_map_cam = then.R_map_rig * R_base_cam_;
  state_.holdNewest(
      reference, camera_base_,
      depth_m * depth_m * R_map_cam * rest_.stillness().hidden * R_map_cam.transpose());
  return true;
}

void Msckf::makeReference() {
  const auto old = frameOf(reference_id_);
  if (old && !reference_is_keyframe_ && reference_id_ != newest().id) state_.removeFrame(*old);
  reference_id_ = newest().id;
  reference_is_keyframe_ = false;
}

void Msckf::forgetReference() {
  rest_ = ZeroMotionDetector(config_.rest);
  const auto old = frameOf(reference_id_);
  if (old && !reference_is_keyframe_ && reference_id_ != newest().id) state_.removeFrame(*old);
  reference_id_ = 0;
  reference_is_keyframe_ = false;
  odometry_displacement_.setZero();
}

}  // namespace ardrone_vslam
