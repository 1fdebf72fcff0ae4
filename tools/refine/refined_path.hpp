// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "refine/refinement.hpp"
#include "run/offline_run.hpp"

namespace ardrone_vslam {

/// The pose of base at each of a run's frames: between keyframes the odometry's way (where the
/// camera rests or the odometry jumps the fused one), with what is left over at the next keyframe
/// spread in time. Frames before the record begins keep the fused pose.
std::vector<Eigen::Isometry3d> refinedPath(const RunResult& run, const Refinement& refinement);

/// T_map_rig by the image's stamp [ns]: base, turned by the error of the extrinsics.
using PosesByStamp = std::unordered_map<std::int64_t, Eigen::Isometry3d>;

/// The rig at a record's keyframes and at the frames between them that the filter may have kept.
PosesByStamp refinedPoses(const FlightRecord& record, const Refinement& refinement);

}  // namespace ardrone_vslam
