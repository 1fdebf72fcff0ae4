// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// Whether the folder has KITTI's layout: image_0/.
bool isKittiFolder(const std::string& path);

/// image_0/NNNNNN.png, calib.txt (line P0), times.txt and, optionally, poses.txt (T_cam0_cam, 12
/// numbers a line). map is KITTI's world with the axes of REP-103: T_map_base = R T_cam0_cam R^T, R
/// the rotation of forwardCamera(); poses need not start at identity.
/// @throws std::runtime_error naming the missing or wrong file and the remedy
std::unique_ptr<Sequence> openKittiFolder(const std::string& path);

/// A file of KITTI poses, one for each stamp, as openKittiFolder reads its poses.txt; empty when
/// there is no such file. @throws std::runtime_error naming file, line and fault
Trajectory readKittiPoses(const std::string& path, const std::vector<std::int64_t>& stamps_ns);

}  // namespace ardrone_vslam
