// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam::test {

/// At a place of odom, turned to the left by a yaw; without covariance and twist.
inline OdometryState odometryAt(std::int64_t stamp_ns,
                                const Eigen::Vector3d& position_odom = Eigen::Vector3d::Zero(),
                                double yaw_rad = 0) {
  OdometryState state;
  state.stamp_ns = stamp_ns;
  state.T_odom_base.translation() = position_odom;
  state.T_odom_base.linear() = rotationOf({0, 0, yaw_rad});
  return state;
}

/// The same of a frame, ten of which come each second from stamp 0 on.
inline OdometryState odometryOfFrame(int frame, const Eigen::Vector3d& position_odom,
                                     double yaw_rad = 0) {
  return odometryAt(100'000'000LL * frame, position_odom, yaw_rad);
}

}  // namespace ardrone_vslam::test
