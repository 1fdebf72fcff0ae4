// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_corridor.hpp"

#include <cmath>

#include "world/scene/world_box.hpp"
#include "world/scene/world_posters.hpp"
#include "world/scene/world_walls.hpp"

namespace ardrone_vslam {
namespace {

enum CorridorStream : std::uint64_t { kNear = 40, kFar, kLeft, kRight, kFloor, kCeiling, kBoxes };

/// Every few metres a door, a column of posters or nothing at all.
Painter paintSide(CorridorStream side, std::uint64_t seed) {
  Painter painter(kCorridorLength_m, kCorridorHeight_m, seed, side);
  paintPlaster(painter);
  RandomSource& random = painter.random();
  for (double x = random.uniform(0.3, 1.5); x < kCorridorLength_m - 1.6;) {
    const double kind = random.uniform();
    if (kind < 0.4) {
      paintDoor(painter, x + 0.1);
    } else if (kind < 0.8) {
      paintColumn(painter, x, x + 0.9, random.uniform(0.5, 1.0));
    }
    x += 1.2 + random.uniform(0, 1.3);
  }
  paintSkirting(painter);
  return painter;
}

Painter paintFarEnd(std::uint64_t seed) {
  Painter painter(kCorridorWidth_m, kCorridorHeight_m, seed, kFar);
  paintPlaster(painter);
  paintWindow(painter, kCorridorWidth_m / 2 - 0.65);
  paintSkirting(painter);
  return painter;
}

Painter paintNearEnd(std::uint64_t seed) {
  Painter painter(kCorridorWidth_m, kCorridorHeight_m, seed, kNear);
  paintPlaster(painter);
  paintDoor(painter, kCorridorWidth_m / 2 - 0.45);
  paintColumn(painter, 0.05, 0.6, 0.6);
  paintSkirting(painter);
  return painter;
}

/// Linoleum: speckles, a joint every two metres, darker borders. Rows run along x.
Painter paintFloor(std::uint64_t seed) {
  Painter painter(kCorridorWidth_m, kCorridorLength_m, seed, kFloor);
  const cv::Rect2d all(0, 0, kCorridorWidth_m, kCorridorLength_m);
  painter.fill(all, 120);
  painter.noise(all, 0.03, 14, 0.85);
  for (double x = 0.4; x < kCorridorLength_m; x += 2) {
    painter.fill({0, x, kCorridorWidth_m, 0.008}, 60);
  }
  painter.fill({0, 0, 0.15, kCorridorLength_m}, 70);
  painter.fill({kCorridorWidth_m - 0.15, 0, 0.15, kCorridorLength_m}, 70);
  RandomSource& random = painter.random();
  for (int i = 0; i < 150; ++i) {  // scuffs
    const cv::Point2d at(random.uniform(0.2, kCorridorWidth_m - 0.2),
                         random.uniform(0.2, kCorridorLength_m - 0.2));
    painter.line(at, {at.x + random.uniform(-0.15, 0.15), at.y + random.uniform(-0.15, 0.15)},
                 0.008, random.uniform(30, 90));
  }
  return painter;
}

Painter paintCeiling(std::uint64_t seed) {
  Painter painter(kCorridorWidth_m, kCorridorLength_m, seed, kCeiling);
  const cv::Rect2d all(0, 0, kCorridorWidth_m, kCorridorLength_m);
  painter.fill(all, 195);
  painter.noise(all, 0.4, 5, 0.7);
  for (double x = 1; x < kCorridorLength_m - 1.3; x += 3) {
    painter.fill({kCorridorWidth_m / 2 - 0.14, x - 0.03, 0.28, 1.26}, 90);
    painter.fill({kCorridorWidth_m / 2 - 0.11, x, 0.22, 1.2}, 252);
  }
  return painter;
}

void addFurniture(std::uint64_t seed, std::vector<Surface>& surfaces) {
  RandomSource random(seed, kBoxes);
  std::uint64_t stream = kBoxes + 1;
  for (double x = random.uniform(3, 5); x < kCorridorLength_m - 2; x += random.uniform(3, 6)) {
    const double side = random.chance(0.5) ? 1 : -1;
    const bool is_cupboard = random.chance(0.6);
    const double depth = is_cupboard ? 0.35 : 0.4;
    const Box box{{x, side * (kCorridorWidth_m - depth) / 2, 0},
                  {is_cupboard ? 1.0 : 0.5, depth, is_cupboard ? random.uniform(0.9, 1.7) : 0.5}};
    stream =
        addBox(box, is_cupboard ? paintCupboard : paintCarton, paintWood, seed, stream, surfaces);
  }
}

}  // namespace

Scene makeCorridor(std::uint64_t world_seed) {
  constexpr double kX = kCorridorLength_m, kY = kCorridorWidth_m / 2, kZ = kCorridorHeight_m;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  Scene corridor;
  corridor.surfaces = {makeSurface({kX, kY, kZ}, -y, -z, paintFarEnd(world_seed)),
                       makeSurface({0, -kY, kZ}, y, -z, paintNearEnd(world_seed)),
                       makeSurface({0, kY, kZ}, x, -z, paintSide(kLeft, world_seed)),
                       makeSurface({kX, -kY, kZ}, -x, -z, paintSide(kRight, world_seed)),
                       makeSurface({kX, kY, 0}, -y, -x, paintFloor(world_seed)),
                       makeSurface({0, kY, kZ}, -y, x, paintCeiling(world_seed))};
  corridor.surfaces[4].grain = makeGrain(world_seed);
  addFurniture(world_seed, corridor.surfaces);
  return corridor;
}

}  // namespace ardrone_vslam
