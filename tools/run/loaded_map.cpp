// SPDX-License-Identifier: BSD-3-Clause
#include "run/loaded_map.hpp"

#include <cmath>

namespace ardrone_vslam {

SavedMap loadMap(const std::string& path, const CameraIntrinsics& camera,
                 const SlamConfig& config) {
  SavedMap map = readMap(path);
  const double focal_length_px = std::sqrt(camera.fx_px * camera.fy_px);
  std::string fault =
      cameraDifference(map.cameras, {camera.width_px, camera.height_px, focal_length_px});
  if (fault.empty()) fault = faultOfMaps(config, map.landmarks.size());
  if (!fault.empty()) throw MapFileError(path + ": " + fault);
  return map;
}

}  // namespace ardrone_vslam
