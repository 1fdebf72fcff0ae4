// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/offline_run.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// How long and far the flight was, and how many images each state has.
/// @param path  the truth, or the odometry where none is known
void addFlight(const RunResult& run, const Trajectory& path, nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
