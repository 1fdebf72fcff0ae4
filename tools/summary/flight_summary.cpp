// SPDX-License-Identifier: BSD-3-Clause
#include "summary/flight_summary.hpp"

#include <nlohmann/json.hpp>

#include "trajectory/metrics.hpp"

namespace ardrone_vslam {

void addFlight(const RunResult& run, const Trajectory& path, nlohmann::ordered_json& summary) {
  std::int64_t duration_ns = 0;
  nlohmann::ordered_json states = nlohmann::ordered_json::object();
  for (const RunFrame& frame : run.frames) {
    duration_ns = frame.result.stamp_ns - run.frames.front().result.stamp_ns;
    const char* const name = kSlamStateNames[static_cast<std::size_t>(frame.result.state)];
    states[name] = states.value(name, 0) + 1;
  }
  summary["duration_s"] = static_cast<double>(duration_ns) * 1e-9;
  summary["distance_m"] = path.empty() ? 0 : distancesAlong_m(path).back();
  summary["states"] = states;
}

}  // namespace ardrone_vslam
