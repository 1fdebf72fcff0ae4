// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_buffer.hpp"

/// What two odometry messages, a before b, say of the time between them.
namespace ardrone_vslam {

constexpr double kJump_m = 1e4;  ///< nothing moves by so much between two messages

/// Their stamps' difference.
double secondsBetween(const OdometryState& a, const OdometryState& b);
/// By the twist, axes of odom.
Eigen::Vector3d velocity_odom_m_s(const OdometryState& state);
/// By the poses.
Eigen::Vector3d displacementBetween_m(const OdometryState& a, const OdometryState& b);
/// About the vertical, from -pi to pi.
double turnBetween_rad(const OdometryState& a, const OdometryState& b);
/// The position is kilometres off.
bool isJump(const OdometryState& a, const OdometryState& b);
/// The position began anew at the origin.
bool isReset(const OdometryState& a, const OdometryState& b);
/// After a gap the pose is that in which drivers begin: where it went meanwhile is not known.
bool isStartedAgain(const OdometryState& a, const OdometryState& b);
/// The same message again.
bool isRepeated(const OdometryState& a, const OdometryState& b);

}  // namespace ardrone_vslam
