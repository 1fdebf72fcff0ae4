// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// Hamming distances of 512-bit descriptors on raw pointers. The scalar form is the definition:
// every other form gives the same numbers.
namespace ardrone_vslam::kernels {

constexpr int kHammingGroup = 16;
constexpr int kHammingWords = 8;

/// Descriptors to compare with, word by word: word w of descriptor k is at
/// words[128 (k / 16) + 16 w + k % 16], with room for whole groups of 16. Those of a last, partial
/// group are anything. A tile of 256 (16 KB) stays in the first-level cache while many queries
/// pass.
struct HammingTile {
  const std::uint64_t* words;
  int count;
  int first_index;  ///< of the first descriptor among all: it is what is reported
};

/// The nearest descriptor found so far and the distance of the second nearest; of equally near ones
/// the one with the lowest index, whatever the order of comparison (BestTwo::offer).
struct HammingNearest {
  std::int32_t index;          ///< -1: none yet
  std::int32_t distance_bits;  ///< kNoDistance_bits: none yet
  std::int32_t second_distance_bits;
};

/// For each descriptor of a tile the nearest query so far; arrays with room for whole groups.
struct HammingMutual {
  std::uint16_t* distances_bits;
  std::uint16_t* queries;  ///< of equally near ones the first that came
};

/// Compares one query with a tile.
/// @param query  8 words
/// @param nearest  updated
void hammingNearestScalar(const std::uint64_t* query, const HammingTile& tile,
                          HammingNearest& nearest);

/// The same, and offers the query to each of the tile's descriptors.
/// @param query_number  what is entered in mutual.queries
void hammingMutualScalar(const std::uint64_t* query, std::uint16_t query_number,
                         const HammingTile& tile, HammingNearest& nearest,
                         const HammingMutual& mutual);

/// Brings descriptors into a tile's order.
/// @param descriptors  8 words each, one after the other
/// @param words  room for whole groups; the last group's rest is filled with zeros
void hammingTileWords(const std::uint64_t* descriptors, int count, std::uint64_t* words);

// The other forms; only the files of this machine's architecture define theirs.
void hammingNearestAvx2(const std::uint64_t* query, const HammingTile& tile,
                        HammingNearest& nearest);
void hammingMutualAvx2(const std::uint64_t* query, std::uint16_t query_number,
                       const HammingTile& tile, HammingNearest& nearest,
                       const HammingMutual& mutual);
void hammingNearestAvx512(const std::uint64_t* query, const HammingTile& tile,
                          HammingNearest& nearest);
void hammingMutualAvx512(const std::uint64_t* query, std::uint16_t query_number,
                         const HammingTile& tile, HammingNearest& nearest,
                         const HammingMutual& mutual);
void hammingNearestNeon(const std::uint64_t* query, const HammingTile& tile,
                        HammingNearest& nearest);
void hammingMutualNeon(const std::uint64_t* query, std::uint16_t query_number,
                       const HammingTile& tile, HammingNearest& nearest,
                       const HammingMutual& mutual);

}  // namespace ardrone_vslam::kernels
