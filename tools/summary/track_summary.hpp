// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/offline_run.hpp"

namespace ardrone_vslam {

/// How many tracks lie between pixels, and whether they err as they are said to.
void addTracks(const RunResult& run, nlohmann::ordered_json& summary);
/// The odometry's noise as the tracks have told it by the last frame.
void addLearnedNoise(const RunResult& run, nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
