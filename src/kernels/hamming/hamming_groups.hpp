// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kernels/hamming/hamming_kernels.hpp"

// What the forms of the comparison share: they differ in how the distances of a group of 16 are
// computed. Included by files that are compiled for different instruction sets, so everything in it
// has internal linkage.
namespace ardrone_vslam::kernels {
namespace {

/// Distances at least as large cannot change the result. An equally near one may: it has a lower
/// index if the tiles do not come in order.
inline std::int32_t limitOf(const HammingNearest& nearest) {
  return nearest.second_distance_bits > nearest.distance_bits ? nearest.second_distance_bits
                                                              : nearest.distance_bits + 1;
}

inline void offer(HammingNearest& nearest, std::int32_t index, std::int32_t distance_bits) {
  const bool nearer = distance_bits < nearest.distance_bits ||
                      (distance_bits == nearest.distance_bits && index < nearest.index);
  if (nearer) {
    nearest.second_distance_bits = nearest.distance_bits;
    nearest.distance_bits = distance_bits;
    nearest.index = index;
  } else if (distance_bits < nearest.second_distance_bits) {
    nearest.second_distance_bits = distance_bits;
  }
}

/// Offers those descriptors of a group whose bit is set in `below`. Rare: the expected number of
/// times that one of n is among the two nearest so far is 2 ln n.
inline void offerAll(HammingNearest& nearest, std::int32_t first_index, std::uint32_t below,
                     const std::uint16_t* distances_bits) {
  for (; below != 0; below &= below - 1) {
    const int k = __builtin_ctz(below);
    offer(nearest, first_index + k, distances_bits[k]);
  }
}

/// The bits of those of a group's 16 descriptors that the tile holds.
inline std::uint32_t membersOf(const HammingTile& tile, int first) {
  const int left = tile.count - first;
  return left >= kHammingGroup ? 0xffffU : (1U << left) - 1U;
}

}  // namespace
}  // namespace ardrone_vslam::kernels
