// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace ardrone_vslam::test {

/// Where the x axis of a pose points, seen from above: -pi to pi, positive to the left.
inline double yawOf(const Eigen::Isometry3d& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

}  // namespace ardrone_vslam::test
