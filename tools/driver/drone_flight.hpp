// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "driver/drone_packet.hpp"
#include "simulation/odometry_model.hpp"
#include "trajectory/trajectory.hpp"
#include "world/flight/world_flight.hpp"
#include "world/world.hpp"

namespace ardrone_vslam {

/// A flight as the drone itself measures it.
struct DroneFlight {
  Trajectory truth;                  ///< at the packets
  std::vector<DronePacket> packets;  ///< as many as true poses
  double scale_error = 0;            ///< drawn by the profile
};

/// A whole flight by DroneSensors. @param first_ns  the stamp at the flight's beginning
/// Equal arguments give equal results.
DroneFlight flyDrone(const Flight& flight, const World& world, double duration_s,
                     std::int64_t first_ns, const OdometryProfile& profile, std::uint64_t seed);

}  // namespace ardrone_vslam
