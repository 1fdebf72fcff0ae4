// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "ardrone_vslam/slam_config.hpp"
#include "run/offline_run.hpp"

namespace ardrone_vslam {

/// Why flights with this configuration cannot be refined; empty when they can.
std::string faultOfRefining(const SlamConfig& config);

/// Refines runs whose records were asked for: path and map. Shows how far it is.
/// @return a sentence for each that stays as it was, and why
std::vector<std::string> refineRuns(std::vector<RunResult>& runs);

}  // namespace ardrone_vslam
