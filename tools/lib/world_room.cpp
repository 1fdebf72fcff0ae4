// SPDX-License-Identifier: BSD-3-Clause
#include "world_room.hpp"

#include <algorithm>
#include <cmath>

#include "world_posters.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kCell_m = 0.75;  // about which posters hang
constexpr double kPlainBay_m = 0.6;

enum WallStream : std::uint64_t { kFront, kBack, kLeft, kRight, kFloor, kCeiling };

void paintPlaster(Painter& painter) {
  const cv::Rect2d all(0, 0, painter.width_m(), painter.height_m());
  painter.fill(all, painter.random().uniform(150, 185));
  painter.noise(all, 0.8, 7, 0.6);
}

void paintDoor(Painter& painter, double x) {
  const double top = painter.height_m() - 2.05;
  painter.fill({x - 0.06, top - 0.06, 1.02, 2.11}, 225);
  painter.fill({x, top, 0.9, 2.05}, 95);
  painter.noise({x, top, 0.9, 2.05}, 0.04, 8, 0.8);
  for (const double panel_y : {top + 0.12, top + 1.05}) {
    painter.fill({x + 0.12, panel_y, 0.66, 0.82}, 70);
    painter.fill({x + 0.14, panel_y + 0.02, 0.62, 0.78}, 110);
  }
  painter.ellipse({x + 0.83, top + 1.0}, {0.025, 0.025}, 0, 235);
  painter.lettering({x + 0.2, top + 0.2, 0.5, 0.16}, 240);
}

void paintWindow(Painter& painter, double x) {
  const double top = 0.5, width = 1.3, height = 1.2;
  painter.fill({x - 0.07, top - 0.07, width + 0.14, height + 0.14}, 70);
  painter.fill({x, top, width, height}, 235);
  painter.fill({x, top + 0.75 * height, width, 0.25 * height}, 120);  // trees behind it
  painter.noise({x, top + 0.55 * height, width, 0.45 * height}, 0.15, 28, 0.8);
  painter.fill({x + width / 2 - 0.025, top, 0.05, height}, 70);
  painter.fill({x, top + height / 3, width, 0.04}, 70);
  painter.fill({x - 0.12, top + height + 0.07, width + 0.24, 0.05}, 215);
}

/// A column of posters between `left` and `right`, from below the ceiling down to the skirting.
void paintColumn(Painter& painter, double left, double right, double top) {
  RandomSource& random = painter.random();
  const double bottom = painter.height_m() - 0.14;
  const int rows = std::max(1, static_cast<int>(std::lround((bottom - top) / kCell_m)));
  const double row_m = (bottom - top) / rows;
  for (int row = 0; row < rows; ++row) {
    const double width = (right - left) * random.uniform(0.75, 0.96);
    const double height = row_m * random.uniform(0.75, 0.95);
    const double x = random.uniform(left, right - width);
    const double y = top + row * row_m + random.uniform(0, row_m - height);
    paintPoster(painter, {x, y, width, height});
  }
}

/// Parts of a wall that posters leave free, in x.
struct Bay {
  double begin;
  double end;
};

/// Columns of posters everywhere between the bays, which come in ascending order.
void paintPosters(Painter& painter, std::vector<Bay> bays) {
  bays.push_back({painter.width_m(), painter.width_m()});
  double left = 0;
  for (const auto& bay : bays) {
    const double span = bay.begin - left;
    const int columns = static_cast<int>(std::lround(span / kCell_m));
    for (int i = 0; i < columns; ++i) {
      paintColumn(painter, left + i * span / columns + 0.02, left + (i + 1) * span / columns - 0.02,
                  0.08);
    }
    left = bay.end;
  }
}

void paintSkirting(Painter& painter) {
  painter.fill({0, painter.height_m() - 0.1, painter.width_m(), 0.1}, 75);
  painter.fill({0, painter.height_m() - 0.1, painter.width_m(), 0.012}, 220);
}

/// The wall's special thing, its left side at x. @return what it takes up
Bay paintSpecial(Painter& painter, WallStream wall, double x) {
  switch (wall) {
    case kFront:
      paintBricks(painter, {x, 0, 1.6, kRoomHeight_m});
      return {x, x + 1.6};
    case kBack:
      paintDoor(painter, x);
      return {x - 0.08, x + 0.98};
    default:
      paintWindow(painter, x);
      paintColumn(painter, x - 0.1, x + 1.4, 1.95);
      return {x - 0.14, x + 1.44};
  }
}

Painter paintWall(WallStream wall, double width_m, std::uint64_t seed) {
  Painter painter(width_m, kRoomHeight_m, seed, wall);
  paintPlaster(painter);
  const double middle = width_m / 2;
  const double special_x = painter.random().uniform(0.8, middle - 0.7);
  const double plain_x = painter.random().uniform(middle + 1.0, width_m - 1.5);
  const Bay special = paintSpecial(painter, wall, special_x);
  paintPosters(painter, {special, {plain_x, plain_x + kPlainBay_m}});
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

Surface makeSurface(const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                    const Eigen::Vector3d& down, const Painter& painter) {
  return {corner,
          right,
          down,
          painter.width_m(),
          painter.height_m(),
          Painter::kTexelsPerMetre,
          std::make_shared<MipTexture>(painter.picture())};
}

}  // namespace

Scene makeRoom(std::uint64_t world_seed) {
  constexpr double kX = kRoomLength_m / 2, kY = kRoomWidth_m / 2, kZ = kRoomHeight_m;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  Scene room;
  room.surfaces = {makeSurface({kX, kY, kZ}, -y, -z, paintWall(kFront, kRoomWidth_m, world_seed)),
                   makeSurface({-kX, -kY, kZ}, y, -z, paintWall(kBack, kRoomWidth_m, world_seed)),
                   makeSurface({-kX, kY, kZ}, x, -z, paintWall(kLeft, kRoomLength_m, world_seed)),
                   makeSurface({kX, -kY, kZ}, -x, -z, paintWall(kRight, kRoomLength_m, world_seed)),
                   makeSurface({kX, kY, 0}, -y, -x, paintFloor(world_seed)),
                   makeSurface({-kX, kY, kZ}, -y, x, paintCeiling(world_seed))};
  return room;
}

}  // namespace ardrone_vslam
