// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "world/scene/world_paint.hpp"
#include "world/scene/world_posters.hpp"
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// What is painted on walls, whose upper left corner is the painter's origin [m].
void paintPlaster(Painter& painter);
/// A door of 0.9 m with its frame, standing on the floor, its left side at x.
void paintDoor(Painter& painter, double x);
/// A window of 1.3 x 1.2 m with trees behind it, its left side at x.
void paintWindow(Painter& painter, double x);
void paintSkirting(Painter& painter);
/// A column of posters between `left` and `right`, from `top` down to the skirting.
void paintColumn(Painter& painter, double left, double right, double top,
                 const PosterPaint& paint = paintPoster);

/// Part of a wall that posters leave free, in x.
struct Bay {
  double begin;
  double end;
};
/// Columns of posters everywhere between the bays, which come in ascending order.
void paintPosters(Painter& painter, std::vector<Bay> bays, const PosterPaint& paint = paintPoster);

/// The painted picture as a surface.
Surface makeSurface(const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                    const Eigen::Vector3d& down, const Painter& painter);

}  // namespace ardrone_vslam
