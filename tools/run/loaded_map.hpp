// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// @throws MapFileError as readMap, and for the map of another camera
SavedMap loadMap(const std::string& path, const CameraIntrinsics& camera);

}  // namespace ardrone_vslam
