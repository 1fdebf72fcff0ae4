// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "lens_errors.hpp"
#include "measurements.hpp"
#include "sequences/drone_cameras.hpp"

namespace ardrone_vslam::reproduction {

nlohmann::json measureLens(bool quick) {
  constexpr int kQuickRounds = 3;
  constexpr int kStep_px = 4;  // of the map of errors
  const CameraIntrinsics camera = arDroneFrontCamera();
  const auto methods = bench::lensMethods(camera);
  const auto times = bench::times_ns(camera, methods, quick ? kQuickRounds : bench::kLensRounds);
  nlohmann::json json = {{"width_px", camera.width_px},
                         {"height_px", camera.height_px},
                         {"f_px", camera.fx_px},
                         {"k1", camera.k1},
                         {"k2", camera.k2},
                         {"step_px", kStep_px}};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto errors = bench::errors_px(camera, methods[i]);
    const auto summary = bench::summaryOf(errors);
    nlohmann::json map = nlohmann::json::array();
    if (!methods[i].key.empty())
      for (int y = 0; y < camera.height_px; y += kStep_px)
        for (int x = 0; x < camera.width_px; x += kStep_px)
          map.push_back(
              errors[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width_px) +
                     static_cast<std::size_t>(x)]);
    json["methods"].push_back({{"name", methods[i].name},
                               {"key", methods[i].key},
                               {"mean_px", summary.mean_px},
                               {"largest_px", summary.largest_px},
                               {"time_ns", times[i]},
                               {"map_px", map}});
  }
  return json;
}

}  // namespace ardrone_vslam::reproduction
