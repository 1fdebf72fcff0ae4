// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

/// The odometry's position jumped. Axes of odom.
struct OdometryStep {
  Eigen::Vector3d motion_odom_m = Eigen::Vector3d::Zero();  ///< the way at the speed before it
  Eigen::Vector3d jump_odom_m = Eigen::Vector3d::Zero();    ///< the rest of the odometry's way
  double motion_sigma_m = 0;                                ///< of motion_odom_m, per axis
};

/// Tells steps in the odometry (a reset, a correction written back into it, a sonar that sees a
/// table) from motion: ways far beyond what the speed so far, acceleration and the odometry's own
/// covariance explain. Odometry that had frozen in flight and moves on is a step of unknown size.
class OdometryStepWatch {
 public:
  /// A step is over at once; what goes on for longer is speed.
  static constexpr double kLongest_s = 0.5;

  /// Whether its source was started again since the last one.
  bool isNewStart(const OdometryState& state) const {
    return has_last_ && state.start != last_.start;
  }
  /// One state, in order of the stamps; O(1).
  std::optional<OdometryStep> see(const OdometryState& state);
  /// The way that odometry which is frozen in flight may have missed so far; 0: it is not.
  double frozenWay_m() const;

 private:
  bool has_last_ = false;
  bool has_velocity_ = false;
  OdometryState last_;
  Eigen::Vector3d velocity_odom_m_s_ = Eigen::Vector3d::Zero();  // of the last 0.1 s or so
  double stepping_s_ = 0;  // since the velocity was last learned
  double frozen_s_ = 0;
};

}  // namespace ardrone_vslam
