// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "world/world.hpp"

namespace ardrone_vslam::test {

/// make_world's room, made once.
inline const World& room() {
  static const World world = makeWorld("room", "steady", 0);
  return world;
}

}  // namespace ardrone_vslam::test
