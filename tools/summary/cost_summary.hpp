// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/offline_run.hpp"

namespace ardrone_vslam {

/// Time and memory, and the images that went without some work (`frame_budget_ms`).
void addCost(const RunResult& run, nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
