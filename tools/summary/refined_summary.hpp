// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "run/offline_run.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// At the exposures of its frames. @pre the run was refined
Trajectory refinedTrajectory(const RunResult& run);

/// What a refinement made of the run; nothing without one.
/// @param truth  at some of its frames
void addRefinement(const RunResult& run, const Trajectory& truth, nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
