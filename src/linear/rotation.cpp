// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/rotation.hpp"

#include <cmath>

#include "linear/portable_math.hpp"

namespace ardrone_vslam {

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& rotation_vector) {
  const double angle_rad = rotation_vector.norm();
  constexpr double kNone = 1e-15;
  if (angle_rad < kNone) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d axis = rotation_vector / angle_rad;
  const double cosine = portable::cos(angle_rad);
  const Eigen::Matrix3d turned = skew(portable::sin(angle_rad) * axis);
  return cosine * Eigen::Matrix3d::Identity() + (1 - cosine) * axis * axis.transpose() + turned;
}

Eigen::Matrix3d rotationAboutZ(double angle_rad) {
  const double sine = portable::sin(angle_rad);
  const double cosine = portable::cos(angle_rad);
  Eigen::Matrix3d R;
  R << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  return R;
}

Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sine = q.vec().norm();
  if (sine == 0) return Eigen::Vector3d::Zero();
  const double angle_rad = 2 * portable::atan2(sine, std::abs(q.w()));
  return (q.w() < 0 ? -angle_rad : angle_rad) / sine * q.vec();
}

double angleOf_rad(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return 2 * portable::atan2(q.vec().norm(), std::abs(q.w()));
}

double yawOf(const Eigen::Matrix3d& R) {
  return portable::atan2(R(1, 0), R(0, 0));
}

Eigen::Matrix3d rotationBetween(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, double share) {
  return A * rotationOf(share * rotationVectorOf(A.transpose() * B));
}

std::optional<float> imageRoll_rad(const Eigen::Matrix3d& R_odom_cam) {
  constexpr double kSmallest = 0.2588;  // sine of 15 degrees
  const Eigen::Vector3d down_cam = -R_odom_cam.row(2).transpose();
  if (!(portable::hypot(down_cam.x(), down_cam.y()) > kSmallest)) return std::nullopt;
  return static_cast<float>(portable::atan2(-down_cam.x(), down_cam.y()));
}

}  // namespace ardrone_vslam
