// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace ardrone_vslam {

constexpr double kPacketRate_hz = 200;                ///< of the AR.Drone with navdata_demo 0
constexpr double kPacketStep_s = 1 / kPacketRate_hz;  ///< from one packet to the next

/// What the AR.Drone measures and sends 200 times a second. Base is its middle, x forward, y left,
/// z up; odom is the world with its origin where the drone was when it was switched on.
struct DronePacket {
  /// As the field `state` of its messages has them.
  enum class State : std::uint32_t {
    kUnknown = 0,  ///< motors cut
    kLanded = 2,
    kFlying = 3,
    kHovering = 4,
    kTakingOff = 6,
    kLanding = 8
  };
  using Variances = Eigen::Matrix<double, 6, 1>;  // translation, then rotation about x, y, z

  double clock_s = 0;  ///< the drone's own
  State state = State::kFlying;
  double battery_percent = 100;
  Eigen::Matrix3d R_odom_base = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_base_m_s = Eigen::Vector3d::Zero();
  double altitude_m = 0;  ///< above what is below, smoothed
  Eigen::Vector3d specific_force_base_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_rate_base_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d magnetic_field_base = Eigen::Vector3d::Zero();  ///< raw
  /// Of the integrated velocities with the attitude, and of velocity and turn rate: what the drone
  /// does not send and a driver without fault would tell.
  Variances pose_variances = Variances::Zero();
  Variances twist_variances = Variances::Zero();
};

}  // namespace ardrone_vslam
