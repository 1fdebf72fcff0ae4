// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/slam_config.hpp"

namespace ardrone_vslam {

/// @throws MapFileError as readMap, for the map of another camera, and with the faultOfMaps
SavedMap loadMap(const std::string& path, const CameraIntrinsics& camera, const SlamConfig& config);

}  // namespace ardrone_vslam
