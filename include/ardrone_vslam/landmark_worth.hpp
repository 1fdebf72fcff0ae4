// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// What a full map can spare (thesis 5.1: by use, age, deviation and neighbours). A landmark is
/// worth the more the more often it was matched, the more recently, and the better it is known for
/// its distance. Of those in one cell of space, a tenth to a fifth of the distance wide, the n-th
/// best counts an n-th of that. So no place is lost whole, and a new one finds room.
/// @return `count` ids (or all), the least worth first. O(n log n)
std::vector<std::uint32_t> leastWorth(const Landmarks& landmarks, std::size_t count);

}  // namespace ardrone_vslam
