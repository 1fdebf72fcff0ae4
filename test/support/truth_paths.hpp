// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "trajectory/trajectory.hpp"

namespace ardrone_vslam::test {

/// Constant velocity along x at 10 Hz, beginning at `first_ns`.
inline Trajectory straightLine(double speed_m_s, double seconds, std::int64_t first_ns = 0) {
  Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(std::lround(seconds * 10)); ++i) {
    StampedPose pose;
    pose.stamp_ns = first_ns + i * std::int64_t{100000000};
    pose.T_frame_body.translation() << speed_m_s * 0.1 * i, 0, 1;
    trajectory.append(pose);
  }
  return trajectory;
}

/// Along x from the origin, a pose each `step_m`; 10 Hz from stamp 0 on.
inline Trajectory straightPath(int poses, double step_m) {
  Trajectory trajectory;
  for (int i = 0; i < poses; ++i) {
    StampedPose pose;
    pose.stamp_ns = i * std::int64_t{100000000};
    pose.T_frame_body.translation() << step_m * i, 0, 0;
    trajectory.append(pose);
  }
  return trajectory;
}

/// A circle of 3 m with the nose along the path, climbing, banked.
inline Trajectory circle() {
  Trajectory trajectory;
  for (int i = 0; i <= 200; ++i) {
    StampedPose pose;
    const double angle = 0.03 * i;
    pose.stamp_ns = 5000000000 + i * std::int64_t{33333333};
    pose.T_frame_body.linear() = (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
    pose.T_frame_body.translation() << 3 * std::sin(angle), -3 * std::cos(angle), 0.01 * i;
    trajectory.append(pose);
  }
  return trajectory;
}

}  // namespace ardrone_vslam::test
