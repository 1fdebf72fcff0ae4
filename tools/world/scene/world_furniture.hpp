// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// The table in the middle of the furnished room [m].
constexpr double kTableLength_m = 1.2;  // along x
constexpr double kTableWidth_m = 0.8;
constexpr double kTableHeight_m = 0.75;

/// makeRoom with furniture along its walls and a table in its middle, which the laps go around; its
/// floor and table top show grain from nearby.
Scene makeFurnishedRoom(std::uint64_t world_seed);

/// One of a hotel's rooms: its furniture is the same in all of them, and its posters are repeated
/// in the room and in the others. The seed decides where they hang, and paints floor and ceiling.
Scene makeHotelRoom(std::uint64_t world_seed);

}  // namespace ardrone_vslam
