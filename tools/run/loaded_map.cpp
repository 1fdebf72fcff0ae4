// SPDX-License-Identifier: BSD-3-Clause
#include "run/loaded_map.hpp"

#include <cmath>

namespace ardrone_vslam {

SavedMap loadMap(const std::string& path, const CameraIntrinsics& camera) {
  SavedMap map = readMap(path);
  const double focal_length_px = std::sqrt(camera.fx_px * camera.fy_px);
  const std::string difference =
      cameraDifference(map.camera, {camera.width_px, camera.height_px, focal_length_px});
  if (!difference.empty()) throw MapFileError(path + ": " + difference);
  return map;
}

}  // namespace ardrone_vslam
