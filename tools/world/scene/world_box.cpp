// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_box.hpp"

#include <algorithm>

#include "world/scene/world_walls.hpp"

namespace ardrone_vslam {

void paintWood(Painter& painter) {
  const cv::Rect2d all(0, 0, painter.width_m(), painter.height_m());
  painter.fill(all, painter.random().uniform(90, 150));
  painter.noise(all, 0.06, 12, 0.8, 8);
  painter.noise(all, 0.3, 6, 0.7);
}

void paintCupboard(Painter& painter) {
  paintWood(painter);
  RandomSource& random = painter.random();
  const int columns = std::max(1, static_cast<int>(painter.width_m() / 0.45));
  const int rows = std::max(1, static_cast<int>(painter.height_m() / 0.4));
  const double width = painter.width_m() / columns, height = painter.height_m() / rows;
  for (int i = 0; i < columns * rows; ++i) {
    const double x = (i % columns) * width, y = (i / columns) * height;
    painter.fill({x, y, width, 0.012}, 40);
    painter.fill({x, y, 0.012, height}, 40);
    painter.fill({x + width / 2 - 0.05, y + 0.08, 0.1, 0.025}, 225);
    if (random.chance(0.6)) {
      const cv::Rect2d label(x + 0.06, y + 0.45 * height, 0.6 * width, 0.3 * height);
      painter.fill(label, random.uniform(170, 245));
      painter.lettering(label, random.uniform(10, 60));
    }
  }
}

void paintCarton(Painter& painter) {
  RandomSource& random = painter.random();
  const double width = painter.width_m(), height = painter.height_m();
  const cv::Rect2d all(0, 0, width, height);
  painter.fill(all, random.uniform(120, 165));
  painter.noise(all, 0.1, 7, 0.8);
  painter.fill({0.46 * width, 0, 0.08 * width, height}, 200);  // tape
  painter.lettering({0.05 * width, 0.1 * height, 0.9 * width, 0.25 * height}, 25);
  const cv::Rect2d label(random.uniform(0.05, 0.3) * width, 0.45 * height, 0.5 * width,
                         0.4 * height);
  painter.fill(label, 235);
  const double line_m = label.height / 4;
  for (int i = 0; i < 3; ++i) {
    painter.lettering({label.x + 0.01, label.y + (i + 0.5) * line_m, label.width, line_m}, 20);
  }
}

void paintClothes(Painter& painter) {
  RandomSource& random = painter.random();
  const double height = painter.height_m();
  const double waist = 0.55 * height;
  painter.fill({0, 0, painter.width_m(), 0.15 * height}, random.uniform(150, 210));
  painter.fill({0, waist, painter.width_m(), height - waist}, random.uniform(20, 80));
  for (double y = 0.15 * height; y < waist; y += 0.05) {
    painter.fill({0, y, painter.width_m(), 0.05}, random.uniform(20, 240));
  }
  painter.noise({0, 0, painter.width_m(), height}, 0.15, 18, 0.8);
}

std::uint64_t addBox(const Box& box, const FacePaint& sides, const FacePaint& top,
                     std::uint64_t seed, std::uint64_t stream, std::vector<Surface>& surfaces) {
  const Eigen::Isometry3d T_world_box =
      Eigen::Translation3d(box.foot) * Eigen::AngleAxisd(box.yaw_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d half = 0.5 * box.size;
  const double height = box.size.z();
  const auto add = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                       const Eigen::Vector3d& down, double width_m, double height_m,
                       const FacePaint& paint) {
    Painter painter(width_m, height_m, seed, stream++);
    paint(painter);
    surfaces.push_back(moved(makeSurface(corner, right, down, painter), T_world_box));
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  add({half.x(), -half.y(), height}, y, -z, box.size.y(), height, sides);
  add({-half.x(), half.y(), height}, -y, -z, box.size.y(), height, sides);
  add({half.x(), half.y(), height}, -x, -z, box.size.x(), height, sides);
  add({-half.x(), -half.y(), height}, x, -z, box.size.x(), height, sides);
  add({half.x(), half.y(), height}, -y, -x, box.size.y(), box.size.x(), top);
  return stream;
}

Surface moved(const Surface& surface, const Eigen::Isometry3d& T_world_local) {
  Surface result = surface;
  result.corner = T_world_local * surface.corner;
  result.right = T_world_local.linear() * surface.right;
  result.down = T_world_local.linear() * surface.down;
  return result;
}

std::shared_ptr<const Grain> makeGrain(std::uint64_t seed) {
  constexpr double kTexelsPerMetre = 1000;  // of what is painted in other units
  constexpr std::uint64_t kStream = 90;
  Painter painter(4, 4, seed, kStream);
  const cv::Rect2d all(0, 0, painter.width_m(), painter.height_m());
  painter.noise(all, 0.06, 9, 0.9);
  return std::make_shared<Grain>(painter.picture(), kTexelsPerMetre);
}

}  // namespace ardrone_vslam
