// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// Inside of the corridor [m]: x from 0, y about 0, z from the floor up.
constexpr double kCorridorLength_m = 33;
constexpr double kCorridorWidth_m = 2.4;
constexpr double kCorridorHeight_m = 2.6;

/// A corridor with doors, notice boards, long plain stretches, cupboards and boxes along its walls,
/// lamps at its ceiling and a window at its far end. The seed decides where and what.
Scene makeCorridor(std::uint64_t world_seed);

}  // namespace ardrone_vslam
