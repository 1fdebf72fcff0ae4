// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set's comparison of queries with tiles against BestTwo, bit by bit.
#include <gtest/gtest.h>

#include <array>
#include <bitset>
#include <random>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "kernels/kernels.hpp"
#include "matching/match_acceptance.hpp"

namespace ardrone_vslam::test {
namespace {

using kernels::HammingNearest;
using Descriptors = std::vector<Descriptor>;

int distance_bits(const Descriptor& a, const Descriptor& b) {
  std::size_t bits = 0;
  for (std::size_t w = 0; w < 8; ++w) bits += std::bitset<64>(a.words[w] ^ b.words[w]).count();
  return static_cast<int>(bits);
}

/// A few bits make ties abound; all of them also give the extremes, 0 and 512.
Descriptors draw(std::size_t count, std::uint64_t mask, std::mt19937_64& random) {
  Descriptors descriptors(count);
  for (auto& descriptor : descriptors) {
    const bool extreme = random() % 16 == 0;
    const std::uint64_t fill = random() % 2 == 0 ? 0 : ~std::uint64_t{0};
    for (auto& word : descriptor.words) word = (extreme ? fill : random()) & mask;
  }
  return descriptors;
}

std::vector<std::uint64_t> tileOf(const Descriptors& train) {
  const std::size_t groups = (train.size() + 15) / 16;
  std::vector<std::uint64_t> words(groups * 128 + 1, 0x1234);
  kernels::hammingTileWords(train.front().words.data(), static_cast<int>(train.size()),
                            words.data());
  EXPECT_EQ(words.back(), 0x1234U) << "written beyond the last group";
  words.pop_back();
  // What fills up the last group must not matter: make it the nearest of all.
  for (std::size_t k = train.size(); k < 16 * groups; ++k) {
    for (std::size_t w = 0; w < 8; ++w)
      words[128 * (k / 16) + 16 * w + k % 16] = train.front().words[w];
  }
  return words;
}

void expectNearest(const HammingNearest& nearest, const BestTwo& expected) {
  EXPECT_EQ(nearest.index, expected.index);
  EXPECT_EQ(nearest.distance_bits, expected.distance_bits);
  EXPECT_EQ(nearest.second_distance_bits, expected.second_distance_bits);
}

struct MutualArrays {
  explicit MutualArrays(std::size_t count)
      : distances((count + 15) / 16 * 16, kNoDistance_bits), queries(distances.size(), 999) {}
  kernels::HammingMutual view() { return {distances.data(), queries.data()}; }
  std::vector<std::uint16_t> distances, queries;
};

class HammingKernels : public ::testing::TestWithParam<InstructionSet> {
 protected:
  /// Compares all queries with the train descriptors, in two tiles, the later part first.
  void compare(const Descriptors& query, const Descriptors& train) const {
    const auto middle = static_cast<std::ptrdiff_t>(train.size() / 2);
    const Descriptors later(train.begin() + middle, train.end());
    const Descriptors earlier(train.begin(), train.begin() + middle);
    std::vector<HammingNearest> alone(query.size(), {-1, kNoDistance_bits, kNoDistance_bits});
    std::vector<HammingNearest> mutually = alone;
    std::vector<BestTwo> expected(query.size());
    for (const auto* part : {&later, &earlier}) {
      if (part->empty()) continue;
      const auto words = tileOf(*part);
      const int first = part == &later ? static_cast<int>(middle) : 0;
      const kernels::HammingTile tile{words.data(), static_cast<int>(part->size()), first};
      MutualArrays arrays(part->size());
      std::vector<BestTwo> expected_of_train(part->size());
      for (std::size_t q = 0; q < query.size(); ++q) {
        kernels.hamming_nearest(query[q].words.data(), tile, alone[q]);
        kernels.hamming_mutual(query[q].words.data(), static_cast<std::uint16_t>(q), tile,
                               mutually[q], arrays.view());
        for (std::size_t t = 0; t < part->size(); ++t) {
          const int bits = distance_bits(query[q], (*part)[t]);
          expected[q].offer(first + static_cast<int>(t), bits);
          expected_of_train[t].offer(static_cast<int>(q), bits);
        }
      }
      for (std::size_t t = 0; t < part->size(); ++t) {
        EXPECT_EQ(arrays.distances[t], expected_of_train[t].distance_bits);
        EXPECT_EQ(arrays.queries[t], expected_of_train[t].index);
      }
    }
    for (std::size_t q = 0; q < query.size(); ++q) {
      expectNearest(alone[q], expected[q]);
      expectNearest(mutually[q], expected[q]);
    }
  }

  const kernels::Kernels kernels = kernels::kernelsFor(GetParam());
};

TEST_P(HammingKernels, EqualTheOracleForEveryTileSizeAndWithManyTies) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const std::uint64_t mask :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0x8000000000000101}, ~std::uint64_t{0}}) {
    for (std::size_t trains = 1; trains <= 70; ++trains) {
      SCOPED_TRACE(std::to_string(trains) + " train descriptors");
      compare(draw(1 + trains % 9, mask, random), draw(trains, mask, random));
      if (HasFailure()) return;
    }
    compare(draw(40, mask, random), draw(512, mask, random));
  }
}

TEST_P(HammingKernels, EveryBitOfEveryPlaceCounts) {
  Descriptors train(16);
  for (std::size_t place = 0; place < 16; ++place) {
    for (std::size_t bit = 0; bit < 512; ++bit) {
      train.assign(16, Descriptor{});
      train[place].words[bit / 64] = std::uint64_t{1} << (bit % 64);
      const auto words = tileOf(train);
      Descriptor query;
      query.words.fill(~std::uint64_t{0});
      HammingNearest nearest{-1, kNoDistance_bits, kNoDistance_bits};
      kernels.hamming_nearest(query.words.data(), {words.data(), 16, 100}, nearest);
      ASSERT_EQ(nearest.index, 100 + static_cast<int>(place)) << bit;
      ASSERT_EQ(nearest.distance_bits, 511) << bit;
      ASSERT_EQ(nearest.second_distance_bits, 512) << bit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, HammingKernels, ::testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& parameter) {
                           return std::string(nameOf(parameter.param));
                         });

}  // namespace
}  // namespace ardrone_vslam::test
