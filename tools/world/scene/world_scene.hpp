// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "world/scene/world_texture.hpp"

namespace ardrone_vslam {

/// A textured rectangle, seen from one side only. Facing it, `right` and `down` are the directions
/// of the picture's columns and rows and `corner` is its upper left corner [m, world].
struct Surface {
  Eigen::Vector3d corner;
  Eigen::Vector3d right;
  Eigen::Vector3d down;
  double width_m;
  double height_m;
  double texels_per_m;
  std::shared_ptr<const MipTexture> texture;
  /// Grain about a mean of 128 that is added for cameras so near that they see single texels;
  /// repeated all over the surface. May be empty.
  std::shared_ptr<const Grain> grain = nullptr;
};

/// How much of its painted grey a place shows: an even light and one lamp without shadows.
struct Lighting {
  double even = 1;
  double lamp = 0;          ///< right at the lamp
  double lamp_reach_m = 1;  ///< where the lamp's light has fallen to a half
  Eigen::Vector3d lamp_m = Eigen::Vector3d::Zero();  ///< where it hangs, world
};

/// What there is to see at one moment. Rectangles may hide each other.
struct Scene {
  std::vector<Surface> surfaces;
  Lighting lighting = {};
};

/// Way along a ray to the first surface that faces it, in lengths of `direction`; nothing when it
/// meets none.
std::optional<double> rangeAlong(const Scene& scene, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& direction);

}  // namespace ardrone_vslam
