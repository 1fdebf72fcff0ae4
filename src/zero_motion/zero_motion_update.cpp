// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/zero_motion_update.hpp"

#include <cmath>

#include "linear/scalars.hpp"

namespace ardrone_vslam {

bool mayBeDrift(double error_m, double passed_s) {
  constexpr double kFastest_m_s = 0.5;
  return error_m <= kFastest_m_s * passed_s;
}

double rotationSigma_rad(const WindowState& state, std::size_t frame) {
  const Matrix6d relative = state.relativeCovariance(
      state.frameCoordinate(frame), state.frameCoordinate(state.frames().size() - 1));
  return std::sqrt(relative.bottomRightCorner<3, 3>().trace() / 3);
}

void ZeroMotionUpdate::apply(const ImageFeatures& features, const Eigen::Isometry3d& T_rig_cam,
                             const Eigen::Isometry3d& T_odom_base, bool is_located,
                             WindowState& state) {
  scene_depth_.see(features, T_odom_base * T_rig_cam);
  const auto reference = indexOf(state.frames(), reference_id_);
  OdometryRotation rotation;
  if (!reference) detector_ = ZeroMotionDetector();
  if (reference && reference_id_ != state.newest().id) {
    const Eigen::Matrix3d R_rig_cam = T_rig_cam.linear();
    rotation.sigma_rad = rotationSigma_rad(state, *reference);
    rotation.R_reference_now = (state.frames()[*reference].R_map_rig * R_rig_cam).transpose() *
                               state.newest().R_map_rig * R_rig_cam;
  }
  motion_ = detector_.see(features, rotation);
  const bool is_still = motion_ == CameraMotion::kResting || motion_ == CameraMotion::kRotating;
  if (is_still && reference && !is_located && !holdStill(*reference, T_rig_cam, state))
    motion_ = CameraMotion::kMoving;
  if (!is_still) odometry_displacement_.setZero();
  if (!detector_.isReference()) return;
  dropReference(state);
  reference_id_ = state.newest().id;
  reference_is_keyframe_ = false;
}

bool ZeroMotionUpdate::holdStill(std::size_t reference, const Eigen::Isometry3d& T_rig_cam,
                                 WindowState& state) {
  // The scene may be further away than what is known of it says, and the image hide more motion.
  constexpr double kNearerSurely = 0.97;
  const Eigen::Vector3d camera_rig = T_rig_cam.translation();
  const Clone& then = state.frames()[reference];
  const Clone& now = state.newest();
  odometry_displacement_ += now.position_map + now.R_map_rig * camera_rig - then.position_map -
                            then.R_map_rig * camera_rig;
  constexpr double kJitter_m = 0.1;  // of odometry, in the first moments
  if (!mayBeDrift(odometry_displacement_.norm() - kJitter_m, detector_.still_s())) return false;
  const Eigen::Matrix3d R_rig_cam = T_rig_cam.linear();
  const Eigen::Matrix3d R_map_cam = then.R_map_rig * R_rig_cam;
  state.holdNewest(reference, camera_rig,
                   squared(scene_depth_.quantile_m(kNearerSurely)) * R_map_cam *
                       detector_.stillness().hidden * R_map_cam.transpose());
  return true;
}

void ZeroMotionUpdate::dropReference(WindowState& state) const {
  const auto reference = indexOf(state.frames(), reference_id_);
  if (reference && isReferenceOnly(reference_id_) && reference_id_ != state.newest().id)
    state.removeFrame(*reference);
}

void ZeroMotionUpdate::beginAnew(WindowState& state) {
  dropReference(state);
  reset();
}

void ZeroMotionUpdate::reset() {
  detector_ = ZeroMotionDetector();
  scene_depth_ = SceneDepth();
  reference_id_ = 0;
  reference_is_keyframe_ = false;
  odometry_displacement_.setZero();
}

}  // namespace ardrone_vslam
