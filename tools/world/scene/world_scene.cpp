// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

std::optional<double> rangeAlong(const Scene& scene, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& direction) {
  constexpr double kOnSurface_m = 1e-6;
  double over_length = 0;  // reciprocal of the nearest hit's
  for (const auto& surface : scene.surfaces) {
    const Eigen::Vector3d away = surface.right.cross(surface.down);
    const double distance_m = away.dot(surface.corner - from);
    if (distance_m <= kOnSurface_m) continue;  // seen from behind
    const double nearer = away.dot(direction) / distance_m;
    if (nearer <= over_length) continue;
    const Eigen::Vector3d hit = from + direction / nearer - surface.corner;
    const double right_m = surface.right.dot(hit), down_m = surface.down.dot(hit);
    const bool is_on_it =
        right_m >= 0 && right_m <= surface.width_m && down_m >= 0 && down_m <= surface.height_m;
    if (is_on_it) over_length = nearer;
  }
  if (over_length == 0) return std::nullopt;
  return 1 / over_length;
}

}  // namespace ardrone_vslam
