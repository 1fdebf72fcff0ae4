// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/image_roll.hpp"

#include <cmath>

namespace ardrone_vslam {

std::optional<float> imageRoll_rad(const Eigen::Matrix3d& R_odom_cam) {
  constexpr double kSmallest = 0.2588;  // sine of 15 degrees
  const Eigen::Vector3d down_cam = -R_odom_cam.row(2).transpose();
  if (!(std::hypot(down_cam.x(), down_cam.y()) > kSmallest)) return std::nullopt;
  return static_cast<float>(std::atan2(-down_cam.x(), down_cam.y()));
}

}  // namespace ardrone_vslam
