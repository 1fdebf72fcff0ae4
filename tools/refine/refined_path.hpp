// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "refine/refinement.hpp"
#include "run/offline_run.hpp"

namespace ardrone_vslam {

/// The pose of base at each of a run's frames: between keyframes the odometry's way (where the
/// camera rests or the odometry jumps the fused one), with what is left over at the next keyframe
/// spread in time. Frames before the record begins keep the fused pose.
std::vector<Eigen::Isometry3d> refinedPath(const RunResult& run, const Refinement& refinement);

}  // namespace ardrone_vslam
