// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/streams/adapted_odometry.hpp"

#include <utility>

namespace ardrone_vslam {

AdaptedOdometry adapt(const DoctorRecording& recording, OdometryMode mode, OdometryHeight height) {
  OdometryAdapterConfig config;
  config.mode = mode;
  config.height = height;
  OdometryAdapter adapter(config);
  AdaptedOdometry adapted;
  std::vector<OdometryState> ready;
  const auto collect = [&] {
    for (OdometryState& state : ready) {
      const bool ascends =
          adapted.states.empty() || state.stamp_ns > adapted.states.back().stamp_ns;
      if (ascends) adapted.states.push_back(std::move(state));
    }
    ready.clear();
  };
  for (const DoctorOdometry& odometry : recording.odometry) {
    if (!odometry.state || odometry.state->stamp_ns <= 0) {
      ++adapted.refused;
      continue;
    }
    const auto answer = adapter.push(*odometry.state, ready);
    if (answer == OdometryBuffer::Push::kNotFinite || answer == OdometryBuffer::Push::kOutOfRange) {
      ++adapted.refused;
    }
    collect();
  }
  adapter.flush(ready);
  collect();
  adapted.faults = adapter.faults();
  return adapted;
}

}  // namespace ardrone_vslam
