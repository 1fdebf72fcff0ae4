// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>
#include <random>
#include <vector>

#include "kernels/hamming/hamming_kernels.hpp"

namespace ardrone_vslam::test {
namespace {

using namespace kernels;
using Words = std::vector<std::uint64_t>;

/// Few bits make ties abound.
Words draw(int descriptors, std::uint64_t mask, std::mt19937_64& random) {
  Words words(static_cast<std::size_t>(descriptors) * kHammingWords);
  for (auto& word : words) word = random() & mask;
  for (auto& word : words) word = random() % 64 == 0 ? mask : word;
  return words;
}

struct Form {
  decltype(&hammingNearestScalar) nearest;
  decltype(&hammingMutualScalar) mutual;
};

/// Everything that a form finds, in one list. Two tiles, the later part of the descriptors first.
std::vector<int> compare(const Form& form, const Words& query, const Words& tile_words, int count) {
  std::vector<int> found;
  const auto padded = tile_words.size() / kHammingWords;
  for (int alone = 0; alone < 2; ++alone) {
    std::vector<HammingNearest> nearest(query.size() / kHammingWords, {-1, 513, 513});
    for (const int first : {1000, 0}) {
      std::vector<std::uint16_t> distances_bits(padded, 513);
      std::vector<std::uint16_t> queries(padded, 999);
      const HammingTile tile{tile_words.data(), count, first};
      for (std::size_t q = 0; q < nearest.size(); ++q) {
        const std::uint64_t* words = query.data() + q * kHammingWords;
        if (alone == 1) {
          form.nearest(words, tile, nearest[q]);
        } else {
          form.mutual(words, static_cast<std::uint16_t>(q), tile, nearest[q],
                      {distances_bits.data(), queries.data()});
        }
      }
      for (std::size_t t = 0; t < static_cast<std::size_t>(count); ++t) {
        found.push_back(distances_bits[t]);
        found.push_back(queries[t]);
      }
    }
    for (const HammingNearest& n : nearest)
      found.insert(found.end(), {n.index, n.distance_bits, n.second_distance_bits});
  }
  return found;
}

}  // namespace

/// @return number of faults
int testHammingNeon() {
  int faults = 0;
  std::mt19937_64 random(32);
  const Form scalar{hammingNearestScalar, hammingMutualScalar};
  const Form neon{hammingNearestNeon, hammingMutualNeon};
  for (const std::uint64_t mask :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0x8000000000000101}, ~std::uint64_t{0}}) {
    for (int count = 1; count <= 70; ++count) {
      const Words query = draw(1 + count % 9, mask, random);
      const Words train = draw(count, mask, random);
      Words tile(static_cast<std::size_t>((count + kHammingGroup - 1) / kHammingGroup) * 128);
      hammingTileWords(train.data(), count, tile.data());
      if (compare(neon, query, tile, count) == compare(scalar, query, tile, count)) continue;
      std::printf("hamming kernels differ: %d descriptors\n", count);
      ++faults;
    }
  }
  return faults;
}

}  // namespace ardrone_vslam::test
