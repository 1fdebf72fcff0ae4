// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "world/scene/world_posters.hpp"
#include "world/scene/world_scene.hpp"

namespace ardrone_vslam {

/// Inside of the room [m]. Its world frame has the origin in the middle of the floor, z up.
constexpr double kRoomLength_m = 8;  // along x
constexpr double kRoomWidth_m = 6;   // along y
constexpr double kRoomHeight_m = 3;

/// A box room with boards on its floor, tiles at its ceiling, bricks on a part of one wall, a door,
/// windows and posters; each wall keeps a plain bay. The seed decides where and what.
Scene makeRoom(std::uint64_t world_seed, const PosterPaint& poster = paintPoster);

}  // namespace ardrone_vslam
