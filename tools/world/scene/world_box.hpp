// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "world/scene/world_paint.hpp"
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// A block that stands on something: its bottom is never seen.
struct Box {
  Eigen::Vector3d foot;  ///< middle of its bottom [m, world]
  Eigen::Vector3d size;  ///< along its own x, y and z [m]
  double yaw_rad = 0;
};

/// Paints one of a box's faces; the painter has its size.
using FacePaint = std::function<void(Painter&)>;

void paintWood(Painter& painter);      ///< grain along x
void paintCupboard(Painter& painter);  ///< doors and drawers
void paintCarton(Painter& painter);    ///< a labelled box
void paintClothes(Painter& painter);   ///< stripes and patches

/// Four sides and a top. @param stream  of random numbers; the next free one is returned
std::uint64_t addBox(const Box& box, const FacePaint& sides, const FacePaint& top,
                     std::uint64_t seed, std::uint64_t stream, std::vector<Surface>& surfaces);

/// The surface moved by `T_world_local`.
Surface moved(const Surface& surface, const Eigen::Isometry3d& T_world_local);

/// Fine grain of floors and tables, which a camera sees from a hand's breadth.
std::shared_ptr<const Grain> makeGrain(std::uint64_t seed);

}  // namespace ardrone_vslam
