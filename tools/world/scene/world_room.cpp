// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_room.hpp"

#include <algorithm>
#include <cmath>

#include "world/scene/world_walls.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kPlainBay_m = 0.6;

enum WallStream : std::uint64_t { kFront, kBack, kLeft, kRight, kFloor, kCeiling };

/// The wall's special thing, its left side at x. @return what it takes up
Bay paintSpecial(Painter& painter, WallStream wall, double x, const PosterPaint& poster) {
  switch (wall) {
    case kFront:
      paintBricks(painter, {x, 0, 1.6, kRoomHeight_m});
      return {x, x + 1.6};
    case kBack:
      paintDoor(painter, x);
      return {x - 0.08, x + 0.98};
    default:
      paintWindow(painter, x);
      paintColumn(painter, x - 0.1, x + 1.4, 1.95, poster);
      return {x - 0.14, x + 1.44};
  }
}

Painter paintWall(WallStream wall, double width_m, std::uint64_t seed, const PosterPaint& poster) {
  Painter painter(width_m, kRoomHeight_m, seed, wall);
  paintPlaster(painter);
  const double middle = width_m / 2;
  const double special_x = painter.random().uniform(0.8, middle - 0.7);
  const double plain_x = painter.random().uniform(middle + 1.0, width_m - 1.5);
  const Bay special = paintSpecial(painter, wall, special_x, poster);
  paintPosters(painter, {special, {plain_x, plain_x + kPlainBay_m}}, poster);
  paintSkirting(painter);
  return painter;
}

Painter paintFloor(std::uint64_t seed) {
  // Columns run along the room's width, rows along its length.
  Painter painter(kRoomWidth_m, kRoomLength_m, seed, kFloor);
  paintBoards(painter, {0, 0, kRoomWidth_m, kRoomLength_m});
  const cv::Rect2d carpet(1.6, 2.4, 2.8, 3.2);
  painter.fill(carpet, 60);
  for (int i = 0; i < 16; ++i) {
    const cv::Rect2d square(carpet.x + 0.1 + (i % 4) * 0.65, carpet.y + 0.1 + (i / 4) * 0.75, 0.65,
                            0.75);
    paintPoster(painter, square);
  }
  painter.noise(carpet, 0.02, 10, 0.9);
  return painter;
}

Painter paintCeiling(std::uint64_t seed) {
  Painter painter(kRoomWidth_m, kRoomLength_m, seed, kCeiling);
  constexpr double kTile_m = 0.5;
  RandomSource& random = painter.random();
  const int columns = static_cast<int>(kRoomWidth_m / kTile_m);
  const int rows = static_cast<int>(kRoomLength_m / kTile_m);
  for (int i = 0; i < columns * rows; ++i) {
    const cv::Rect2d tile((i % columns) * kTile_m, (i / columns) * kTile_m, kTile_m, kTile_m);
    painter.fill(tile, 120);
    const bool is_lamp = i % columns % 4 == 1 && i / columns % 4 == 2;
    painter.fill({tile.x + 0.008, tile.y + 0.008, kTile_m - 0.016, kTile_m - 0.016},
                 is_lamp ? 250 : random.uniform(185, 205));
    const int holes = is_lamp ? 0 : random.integer(5, 30);
    for (int hole = 0; hole < holes; ++hole) {
      const double x = tile.x + random.uniform(0.04, kTile_m - 0.04);
      const double y = tile.y + random.uniform(0.04, kTile_m - 0.04);
      const double radius = random.uniform(0.006, 0.022);
      painter.ellipse({x, y}, {radius, radius}, 0, random.uniform(60, 130));
    }
  }
  painter.noise({0, 0, kRoomWidth_m, kRoomLength_m}, 0.5, 4, 0.7);
  return painter;
}

}  // namespace

Scene makeRoom(std::uint64_t world_seed, const PosterPaint& poster) {
  constexpr double kX = kRoomLength_m / 2, kY = kRoomWidth_m / 2, kZ = kRoomHeight_m;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  const auto wall = [&](WallStream which, double width_m) {
    return paintWall(which, width_m, world_seed, poster);
  };
  Scene room;
  room.surfaces = {makeSurface({kX, kY, kZ}, -y, -z, wall(kFront, kRoomWidth_m)),
                   makeSurface({-kX, -kY, kZ}, y, -z, wall(kBack, kRoomWidth_m)),
                   makeSurface({-kX, kY, kZ}, x, -z, wall(kLeft, kRoomLength_m)),
                   makeSurface({kX, -kY, kZ}, -x, -z, wall(kRight, kRoomLength_m)),
                   makeSurface({kX, kY, 0}, -y, -x, paintFloor(world_seed)),
                   makeSurface({-kX, kY, kZ}, -y, x, paintCeiling(world_seed))};
  return room;
}

}  // namespace ardrone_vslam
