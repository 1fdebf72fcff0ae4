// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

// Debian has no library of Lie groups (Sophus, manif); what follows is all that is needed of one.
namespace ardrone_vslam {

/// Rotation matrix of a rotation vector [rad].
Eigen::Matrix3d rotationOf(const Eigen::Vector3d& rotation_vector);

/// Rz: from axes that are turned by this angle about z.
Eigen::Matrix3d rotationAboutZ(double angle_rad);

/// Rotation vector [rad] of a rotation matrix.
Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& R);

/// Of the rotation vector, from 0 to pi.
double angleOf_rad(const Eigen::Matrix3d& R);

/// Heading [rad]: about z, of R = Rz(yaw) Ry(pitch) Rx(roll).
double yawOf(const Eigen::Matrix3d& R);

/// The way from A to B in one turn, of which share is done: 0 is A, to the bit.
Eigen::Matrix3d rotationBetween(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, double share);

/// All 24 rotations that take axes to axes, the identity among them.
inline std::vector<Eigen::Matrix3d> quarterTurns() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Eigen::Matrix3d R;
      R.col(0) = Eigen::Vector3d::Unit(x % 3) * (x < 3 ? 1 : -1);
      R.col(1) = Eigen::Vector3d::Unit(y % 3) * (y < 3 ? 1 : -1);
      R.col(2) = R.col(0).cross(R.col(1));
      rotations.push_back(R);
    }
  }
  return rotations;
}

/// skew(v) w = v x w.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// By how much what stands upright appears turned in the image, from the image's x axis towards its
/// y axis (clockwise as seen); minus the camera's roll: the orientation that FreakDescriber takes.
/// @param R_odom_cam  optical frame (x right, y down, z forward) to a frame whose z axis points up
/// @return nothing where the camera looks within 15 degrees of straight up or down: gravity then
///   says little about the image's turn
std::optional<float> imageRoll_rad(const Eigen::Matrix3d& R_odom_cam);

}  // namespace ardrone_vslam
