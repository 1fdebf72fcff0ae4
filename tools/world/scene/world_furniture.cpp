// SPDX-License-Identifier: BSD-3-Clause
#include "world/scene/world_furniture.hpp"

#include <cmath>

#include "world/scene/world_box.hpp"
#include "world/scene/world_posters.hpp"
#include "world/scene/world_room.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint64_t kFirstStream = 100;

void paintTop(Painter& painter) {
  paintBoards(painter, {0, 0, painter.width_m(), painter.height_m()});
  RandomSource& random = painter.random();
  for (int i = 0; i < 3; ++i) {  // papers that lie about
    const double width = 0.3 * painter.width_m(), height = 0.25 * painter.height_m();
    const cv::Rect2d paper(random.uniform(0, painter.width_m() - width),
                           random.uniform(0, painter.height_m() - height), width, height);
    painter.fill(paper, random.uniform(200, 245));
    for (double y = 0.01; y < height - 0.03; y += 0.035) {
      painter.lettering({paper.x + 0.01, paper.y + y, width - 0.02, 0.03}, 30);
    }
  }
}

std::uint64_t addTable(std::uint64_t seed, std::uint64_t stream, std::vector<Surface>& surfaces) {
  constexpr double kThick_m = 0.04, kLeg_m = 0.06;
  const double x = (kTableLength_m - kLeg_m) / 2, y = (kTableWidth_m - kLeg_m) / 2;
  for (const double side_x : {-x, x}) {
    for (const double side_y : {-y, y}) {
      const Box leg{{side_x, side_y, 0}, {kLeg_m, kLeg_m, kTableHeight_m - kThick_m}};
      stream = addBox(leg, paintWood, paintWood, seed, stream, surfaces);
    }
  }
  const Box slab{{0, 0, kTableHeight_m - kThick_m}, {kTableLength_m, kTableWidth_m, kThick_m}};
  return addBox(slab, paintWood, paintTop, seed, stream, surfaces);
}

void furnish(std::uint64_t world_seed, Scene& room) {
  const auto grain = makeGrain(world_seed);
  for (auto& surface : room.surfaces) {
    if (surface.corner.z() == 0) surface.grain = grain;  // the floor
  }
  std::uint64_t stream = addTable(world_seed, kFirstStream, room.surfaces);
  room.surfaces.back().grain = grain;  // the table's top
  const auto add = [&](const Box& box, const FacePaint& sides) {
    stream = addBox(box, sides, paintTop, world_seed, stream, room.surfaces);
  };
  add({{3.7, 1.8, 0}, {0.6, 1.2, 1.9}}, paintCupboard);
  add({{-3.72, -1.2, 0}, {0.5, 1.6, 1.3}}, paintCupboard);
  add({{-1.0, 2.6, 0}, {2.0, 0.8, 0.45}}, paintClothes);  // a sofa: seat and back
  add({{-1.0, 2.88, 0.45}, {2.0, 0.24, 0.4}}, paintClothes);
  add({{-1.4, -2.65, 0}, {1.4, 0.7, 0.74}}, paintCupboard);
  add({{-1.4, -2.75, 0.74}, {0.5, 0.12, 0.36}}, paintCarton);
  add({{3.4, -2.4, 0}, {0.6, 0.6, 0.55}, 0.3}, paintCarton);
  add({{3.45, -2.45, 0.55}, {0.42, 0.42, 0.4}, -0.2}, paintCarton);
  add({{-3.3, 2.3, 0}, {0.3, 0.3, kRoomHeight_m}}, paintWood);  // a pillar
}

}  // namespace

Scene makeFurnishedRoom(std::uint64_t world_seed) {
  Scene room = makeRoom(world_seed);
  furnish(world_seed, room);
  return room;
}

Scene makeHotelRoom(std::uint64_t world_seed) {
  constexpr std::uint64_t kFurniture = 0;
  Scene room = makeRoom(world_seed, paintPosterOfCatalogue);
  furnish(kFurniture, room);
  return room;
}

}  // namespace ardrone_vslam
