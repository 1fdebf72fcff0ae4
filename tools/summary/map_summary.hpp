// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "run/offline_run.hpp"

/// What a run's loaded map means for its numbers.
namespace ardrone_vslam {

/// By this the odometry is compared as if it had begun in the map, where the flight was found.
Eigen::Isometry3d odometryFrameWhenFound(const RunResult& run, std::size_t found_frame);

/// How long the flight was looked for.
void addMap(const RunResult& run, std::size_t found_frame, nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
