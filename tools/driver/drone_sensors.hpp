// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "driver/drone_packet.hpp"
#include "simulation/odometry_drift.hpp"
#include "simulation/random_source.hpp"
#include "world/flight/world_flight.hpp"

namespace ardrone_vslam {

/// What the drone measures of its own motion, packet by packet. Velocity and attitude drift as the
/// profile says (its rate and its link are the drone's here); their integral is the profile's
/// odometry. Accelerometer and gyroscope have white noise, unless the profile is `truth`.
class DroneSensors {
 public:
  DroneSensors(const OdometryProfile& profile, std::uint64_t seed);

  /// To be called kPacketRate_hz times a second. The packet's state is flying or hovering, by its
  /// speed. @param range_m  of the sonar, down along the body's -z; nothing: no echo
  DronePacket measure(const FlightState& state, const std::optional<double>& range_m);
  /// Drawn by the profile.
  double scaleError() const { return drift_.scaleError(); }

 private:
  /// Height above what is below: the sonar, and between its echoes the vertical velocity.
  double fuseAltitude(const std::optional<double>& range_m, const DronePacket& packet);

  OdometryProfile profile_;
  OdometryDrift drift_;
  RandomSource noise_;
  std::int64_t count_ = 0;
  Eigen::Vector3d last_odom_m_ = Eigen::Vector3d::Zero();
  double travelled_m_ = 0;
  double altitude_m_ = 0;
  bool has_altitude_ = false;
};

}  // namespace ardrone_vslam
