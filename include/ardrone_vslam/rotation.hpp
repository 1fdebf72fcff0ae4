// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ardrone_vslam {

/// Rotation matrix of a rotation vector [rad].
inline Eigen::Matrix3d rotationOf(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  constexpr double kNone = 1e-15;
  if (angle < kNone) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

/// Rotation vector [rad] of a rotation matrix.
inline Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// skew(v) w = v x w.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace ardrone_vslam
