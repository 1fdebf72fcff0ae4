// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_kernels.hpp"
#include "kernels/hamming/hamming_words.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Distances to a group's 16 descriptors: a loop that compilers turn into vectors of what there is.
void groupDistances(const std::uint64_t* query, const std::uint64_t* group,
                    std::uint16_t* distances_bits) {
  for (int k = 0; k < kHammingGroup; ++k) {
    std::uint64_t words[kHammingWords];
    for (int w = 0; w < kHammingWords; ++w) words[w] = group[w * kHammingGroup + k];
    distances_bits[k] = static_cast<std::uint16_t>(hammingDistance512(query, words));
  }
}

}  // namespace

void hammingDistancesScalar(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits) {
  for (std::size_t k = 0; k < count; ++k) {
    distances_bits[k] = static_cast<std::uint16_t>(hammingDistance512(query, train + 8 * k));
  }
}

void hammingNearestScalar(const std::uint64_t* query, const HammingTile& tile,
                          HammingNearest& nearest) {
  for (int first = 0; first < tile.count; first += kHammingGroup) {
    std::uint16_t distances_bits[kHammingGroup];
    groupDistances(query, tile.words + first * kHammingWords, distances_bits);
    offerAll(nearest, tile.first_index + first, membersOf(tile, first), distances_bits);
  }
}

void hammingMutualScalar(const std::uint64_t* query, std::uint16_t query_number,
                         const HammingTile& tile, HammingNearest& nearest,
                         const HammingMutual& mutual) {
  for (int first = 0; first < tile.count; first += kHammingGroup) {
    std::uint16_t distances_bits[kHammingGroup];
    groupDistances(query, tile.words + first * kHammingWords, distances_bits);
    offerAll(nearest, tile.first_index + first, membersOf(tile, first), distances_bits);
    for (int k = 0; k < kHammingGroup; ++k) {
      if (distances_bits[k] >= mutual.distances_bits[first + k]) continue;
      mutual.distances_bits[first + k] = distances_bits[k];
      mutual.queries[first + k] = query_number;
    }
  }
}

void hammingTileWords(const std::uint64_t* descriptors, int count, std::uint64_t* words) {
  for (int first = 0; first < count; first += kHammingGroup) {
    for (int w = 0; w < kHammingWords; ++w) {
      for (int k = 0; k < kHammingGroup; ++k) {
        const int descriptor = first + k;
        *words++ = descriptor < count ? descriptors[kHammingWords * descriptor + w] : 0;
      }
    }
  }
}

}  // namespace ardrone_vslam::kernels
