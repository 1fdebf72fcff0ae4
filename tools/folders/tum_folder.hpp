// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// Whether the folder has the TUM-like layout: image/.
bool isTumFolder(const std::string& path);

/// image/*.png|jpg, camera.yaml, times.txt and, optionally, poses_tum.txt (T_world_cam; its stamps
/// need not be the images') and odometry_tum.txt (T_odom_base). map is the file's world:
/// T_map_base = T_world_cam T_cam_base, T_base_cam = forwardCamera().
/// @throws std::runtime_error naming the missing or wrong file and the remedy
std::unique_ptr<Sequence> openTumFolder(const std::string& path);

}  // namespace ardrone_vslam
