// SPDX-License-Identifier: BSD-3-Clause
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "world/flight/world_motion.hpp"
#include "world/scene/world_box.hpp"
#include "world/scene/world_corridor.hpp"
#include "world/scene/world_furniture.hpp"
#include "world/scene/world_room.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint64_t kFirstStream = 400;

Eigen::Isometry3d placed(double x, double y, double z, double yaw_rad) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

/// Someone who walks up and down beside the laps, a carton that circles the table and a lamp that
/// swings above it.
std::vector<MovingThing> movingThings(std::uint64_t seed) {
  std::vector<MovingThing> things(3);
  const auto paint = [&](std::size_t i, const Eigen::Vector3d& size, const FacePaint& sides) {
    addBox({Eigen::Vector3d::Zero(), size}, sides, sides, seed, kFirstStream + 10 * i,
           things[i].surfaces);
  };
  paint(0, {0.3, 0.45, 1.75}, paintClothes);
  things[0].T_world_thing = [](double t_s) {
    return placed(2.6 * wave(t_s, 0.045, 0), -2.1, 0, 0.2 * wave(t_s, 0.045, 0.5));
  };
  paint(1, {0.45, 0.45, 0.5}, paintCarton);
  things[1].T_world_thing = [](double t_s) {
    const double angle = -0.35 * t_s;
    return placed(1.15 * std::cos(angle), 0.9 * std::sin(angle), 0, angle);
  };
  paint(2, {0.3, 0.3, 0.4}, paintCarton);
  things[2].T_world_thing = [](double t_s) {
    return placed(0.4 * wave(t_s, 0.35, 0), 0.15 * wave(t_s, 0.35, 1), 2.2, 0.5 * t_s);
  };
  return things;
}

[[noreturn]] void refuse(const std::string& what, const std::string& name,
                         const std::vector<std::string>& names) {
  std::string known;
  for (const auto& one : names) known += (known.empty() ? "" : ", ") + one;
  throw std::invalid_argument("there is no " + what + " '" + name + "'; known are " + known);
}

bool isOneOf(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

World::World(Scene standing, std::vector<MovingThing> things, const Extent& extent,
             std::string light)
    : standing_(std::move(standing)),
      things_(std::move(things)),
      extent_(extent),
      light_(std::move(light)) {
  if (!isOneOf(light_, lightNames())) refuse("light", light_, lightNames());
}

Scene World::at(double t_s) const {
  Scene scene = standing_;
  for (const auto& thing : things_) {
    const Eigen::Isometry3d T_world_thing = thing.T_world_thing(t_s);
    for (const auto& surface : thing.surfaces) {
      scene.surfaces.push_back(moved(surface, T_world_thing));
    }
  }
  scene.lighting = lightAt(t_s);
  return scene;
}

std::optional<double> World::rangeBelow_m(const Eigen::Isometry3d& T_world_base, double t_s) const {
  return rangeAlong(at(t_s), T_world_base.translation(), -T_world_base.linear().col(2));
}

Lighting World::lightAt(double t_s) const {
  constexpr double kDarkFrom_s = 20, kDimFrom_s = 32, kFade_s = 1;
  constexpr double kDark = 0.03, kDim = 0.35;
  Lighting light;
  if (light_ == "fading") {
    light.even = 1 - (1 - kDark) * smoothStep((t_s - kDarkFrom_s) / kFade_s) +
                 (kDim - kDark) * smoothStep((t_s - kDimFrom_s) / kFade_s);
  } else if (light_ == "moving") {
    light.even = 0.45;
    light.lamp = 0.9;
    light.lamp_reach_m = 2;
    light.lamp_m = extent_.middle_m + extent_.size_m.cwiseProduct(Eigen::Vector3d(
                                          wave(t_s, 0.04, 0) / 3, wave(t_s, 0.03, 1) / 3, 0.85));
  }
  return light;
}

std::vector<std::string> worldNames() {
  return {"room", "furnished", "moving", "corridor", "hotel"};
}

std::vector<std::string> lightNames() {
  return {"steady", "moving", "fading"};
}

World makeWorld(const std::string& name, const std::string& light, std::uint64_t world_seed) {
  if (name == "corridor") {
    const World::Extent extent{{kCorridorLength_m / 2, 0, 0},
                               {kCorridorLength_m, kCorridorWidth_m, kCorridorHeight_m}};
    return {makeCorridor(world_seed), {}, extent, light};
  }
  const World::Extent extent{{0, 0, 0}, {kRoomLength_m, kRoomWidth_m, kRoomHeight_m}};
  if (name == "room") return {makeRoom(world_seed), {}, extent, light};
  if (name == "furnished") return {makeFurnishedRoom(world_seed), {}, extent, light};
  if (name == "hotel") return {makeHotelRoom(world_seed), {}, extent, light};
  if (name == "moving") {
    return {makeFurnishedRoom(world_seed), movingThings(world_seed), extent, light};
  }
  refuse("world", name, worldNames());
}

}  // namespace ardrone_vslam
