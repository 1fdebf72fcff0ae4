// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/commanded_flight.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kGravity_m_s2 = 9.81;
constexpr double kBrake_per_s = 1.2;  // deceleration per speed, of a drone that is told to hover

}  // namespace

CommandedFlight::CommandedFlight(const DroneMeasurement& begin, double tilt_rad, double time_s)
    : measured_(begin), steepest_(portable::tan(tilt_rad)), time_s_(time_s) {
  const Eigen::Matrix3d& R = begin.R_odom_base;
  const Eigen::Vector3d up = rotationAboutZ(yawOf(R)).transpose() * R.col(2);
  lean_ = between_ = up.head<2>() / up.z();
}

DroneMeasurement CommandedFlight::step(const Eigen::Vector2d& command,
                                       const Eigen::Vector3d& velocity_odom_m_s, double yaw_rad,
                                       double dt_s) {
  const Eigen::Matrix3d R_odom_heading = rotationAboutZ(yaw_rad);
  const Eigen::Vector2d speed_m_s = (R_odom_heading.transpose() * velocity_odom_m_s).head<2>();
  const double share = 1 - portable::exp(-dt_s / time_s_);
  for (int axis = 0; axis < 2; ++axis) {
    const double told = command[axis] != 0 ? steepest_ * command[axis]
                                           : -kBrake_per_s * speed_m_s[axis] / kGravity_m_s2;
    between_[axis] += share * (std::clamp(told, -steepest_, steepest_) - between_[axis]);
    lean_[axis] += share * (between_[axis] - lean_[axis]);
  }
  const Eigen::Vector3d thrust(lean_.x(), lean_.y(), 1);
  const Eigen::Vector3d left = thrust.cross(Eigen::Vector3d::UnitX()).normalized();
  Eigen::Matrix3d R_heading_base;
  R_heading_base << left.cross(thrust.normalized()), left, thrust.normalized();
  measured_.R_odom_base = R_odom_heading * R_heading_base;
  measured_.force_base_m_s2 = kGravity_m_s2 * thrust.norm() * Eigen::Vector3d::UnitZ();
  return measured_;
}

}  // namespace ardrone_vslam
