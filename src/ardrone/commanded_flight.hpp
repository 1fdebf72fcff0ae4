// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone/drone_filter.hpp"

namespace ardrone_vslam {

/// What the drone does while nothing is heard of it: its own controller tilts it as it was told,
/// and against its speed where it was told nothing, both through two equal lags, and keeps its
/// height.
class CommandedFlight {
 public:
  /// @param tilt_rad  at a command of 1
  /// @param time_s  of each lag
  CommandedFlight(const DroneMeasurement& begin, double tilt_rad, double time_s);

  /// @param command  forward and left, within +-1; what is beyond is cut
  /// @param yaw_rad  at the end of the step
  /// @return attitude and force then
  DroneMeasurement step(const Eigen::Vector2d& command, const Eigen::Vector3d& velocity_odom_m_s,
                        double yaw_rad, double dt_s);

 private:
  DroneMeasurement measured_;
  double steepest_;  // tangent, at a command of 1
  double time_s_;
  Eigen::Vector2d between_;  // tangents by which the thrust leans: forward, left
  Eigen::Vector2d lean_;
};

}  // namespace ardrone_vslam
