// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/message_pair.hpp"

#include <cmath>

#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kResetFrom_m = 1;  // a position nearer to the origin than this need not be reset
constexpr double kResetTo_m = 0.1;
constexpr double kResetSpeed_m_s = 100;  // no drone and no car
constexpr double kStart_s = 0.5;         // no driver starts within less
constexpr double kFarFromStart_m = 0.5;
constexpr double kAtStart_m = 0.05;
constexpr double kAtStart_rad = 0.05;

}  // namespace

double secondsBetween(const OdometryState& a, const OdometryState& b) {
  return seconds(b.stamp_ns - a.stamp_ns);
}

Eigen::Vector3d velocity_odom_m_s(const OdometryState& state) {
  return state.T_odom_base.linear() * state.twist_base.head<3>();
}

Eigen::Vector3d displacementBetween_m(const OdometryState& a, const OdometryState& b) {
  return b.T_odom_base.translation() - a.T_odom_base.translation();
}

double turnBetween_rad(const OdometryState& a, const OdometryState& b) {
  const Eigen::Matrix3d R = b.T_odom_base.linear() * a.T_odom_base.linear().transpose();
  return portable::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
}

bool isJump(const OdometryState& a, const OdometryState& b) {
  const double displacement_m = displacementBetween_m(a, b).norm();
  return displacement_m > kJump_m && displacement_m > kFastestOdometry * secondsBetween(a, b);
}

bool isReset(const OdometryState& a, const OdometryState& b) {
  return a.T_odom_base.translation().head<2>().norm() > kResetFrom_m &&
         b.T_odom_base.translation().head<2>().norm() < kResetTo_m &&
         displacementBetween_m(a, b).head<2>().norm() > kResetSpeed_m_s * secondsBetween(a, b);
}

bool isStartedAgain(const OdometryState& a, const OdometryState& b) {
  const Eigen::Isometry3d& start = b.T_odom_base;
  return secondsBetween(a, b) > kStart_s &&
         a.T_odom_base.translation().head<2>().norm() > kFarFromStart_m &&
         start.translation().head<2>().norm() < kAtStart_m &&
         std::abs(portable::atan2(start.linear()(1, 0), start.linear()(0, 0))) < kAtStart_rad;
}

bool isRepeated(const OdometryState& a, const OdometryState& b) {
  return a.T_odom_base.matrix() == b.T_odom_base.matrix() && a.twist_base == b.twist_base;
}

}  // namespace ardrone_vslam
