// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_walls.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr double kCell_m = 0.75;  // about which posters hang

}  // namespace

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

void paintColumn(Painter& painter, double left, double right, double top,
                 const PosterPaint& paint) {
  RandomSource& random = painter.random();
  const double bottom = painter.height_m() - 0.14;
  const int rows = std::max(1, static_cast<int>(std::lround((bottom - top) / kCell_m)));
  const double row_m = (bottom - top) / rows;
  for (int row = 0; row < rows; ++row) {
    const double width = (right - left) * random.uniform(0.75, 0.96);
    const double height = row_m * random.uniform(0.75, 0.95);
    const double x = random.uniform(left, right - width);
    const double y = top + row * row_m + random.uniform(0, row_m - height);
    paint(painter, {x, y, width, height});
  }
}

void paintPosters(Painter& painter, std::vector<Bay> bays, const PosterPaint& paint) {
  bays.push_back({painter.width_m(), painter.width_m()});
  double left = 0;
  for (const auto& bay : bays) {
    const double span = bay.begin - left;
    const int columns = static_cast<int>(std::lround(span / kCell_m));
    for (int i = 0; i < columns; ++i) {
      paintColumn(painter, left + i * span / columns + 0.02, left + (i + 1) * span / columns - 0.02,
                  0.08, paint);
    }
    left = bay.end;
  }
}

void paintSkirting(Painter& painter) {
  painter.fill({0, painter.height_m() - 0.1, painter.width_m(), 0.1}, 75);
  painter.fill({0, painter.height_m() - 0.1, painter.width_m(), 0.012}, 220);
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

}  // namespace ardrone_vslam
