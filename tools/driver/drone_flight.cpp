// SPDX-License-Identifier: BSD-3-Clause
#include "driver/drone_flight.hpp"

#include <cmath>

#include "driver/drone_sensors.hpp"

namespace ardrone_vslam {

DroneFlight flyDrone(const Flight& flight, const World& world, double duration_s,
                     std::int64_t first_ns, const OdometryProfile& profile, std::uint64_t seed) {
  DroneFlight result;
  DroneSensors sensors(profile, seed);
  result.scale_error = sensors.scaleError();
  const auto count = static_cast<std::size_t>(std::ceil(duration_s * kPacketRate_hz)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) * kPacketStep_s;
    const FlightState state = flight.state(t_s);
    result.truth.append({first_ns + std::llround(t_s * 1e9), state.T_world_body});
    result.packets.push_back(sensors.measure(state, world.rangeBelow_m(state.T_world_body, t_s)));
  }
  return result;
}

}  // namespace ardrone_vslam
