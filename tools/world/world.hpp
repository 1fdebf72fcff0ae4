// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// A thing that moves: its surfaces in its own frame, and where that is.
struct MovingThing {
  std::vector<Surface> surfaces;
  std::function<Eigen::Isometry3d(double t_s)> T_world_thing;
};

/// All there is to see, at any time. A rectangular room, standing things, moving ones, light.
class World {
 public:
  /// The middle of the floor is in `middle_m`; the lamp of a moving light stays within a third of
  /// `size_m` about it.
  struct Extent {
    Eigen::Vector3d middle_m;
    Eigen::Vector3d size_m;
  };

  World(Scene standing, std::vector<MovingThing> things, const Extent& extent, std::string light);

  /// What there is to see t_s seconds after the flight's beginning.
  Scene at(double t_s) const;
  /// Way from base down along its -z to what is below: what an ideal sonar measures. Nothing when
  /// the beam meets nothing.
  std::optional<double> rangeBelow_m(const Eigen::Isometry3d& T_world_base, double t_s) const;
  const Extent& extent() const { return extent_; }

 private:
  Lighting lightAt(double t_s) const;

  Scene standing_;
  std::vector<MovingThing> things_;
  Extent extent_;
  std::string light_;
};

/// room: makeRoom; furnished: with a table and furniture; moving: the same with moving boxes;
/// corridor: 33 m long; hotel: rooms that are alike, one for each seed.
std::vector<std::string> worldNames();
/// steady: as painted; moving: a lamp wanders about; fading: dark from 20 to 32 s, then dim.
std::vector<std::string> lightNames();

/// Paints it: takes about a second.
/// @throws std::invalid_argument for unknown names, listing the known ones
World makeWorld(const std::string& name, const std::string& light, std::uint64_t world_seed);

}  // namespace ardrone_vslam
