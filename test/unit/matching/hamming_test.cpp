// SPDX-License-Identifier: BSD-3-Clause
#include "matching/hamming.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <random>
#include <vector>

#include "kernels/hamming/hamming_distances.hpp"

namespace ardrone_vslam {
namespace {

int countedBitByBit(const Descriptor& a, const Descriptor& b) {
  std::size_t bits = 0;
  for (std::size_t w = 0; w < 8; ++w) bits += std::bitset<64>(a.words[w] ^ b.words[w]).count();
  return static_cast<int>(bits);
}

Descriptor filled(std::uint64_t word) {
  Descriptor descriptor;
  descriptor.words.fill(word);
  return descriptor;
}

TEST(Hamming, NoneAndAllBits) {
  EXPECT_EQ(hammingDistance(filled(0), filled(0)), 0);
  EXPECT_EQ(hammingDistance(filled(~std::uint64_t{0}), filled(~std::uint64_t{0})), 0);
  EXPECT_EQ(hammingDistance(filled(0), filled(~std::uint64_t{0})), 512);
}

TEST(Hamming, EverySingleBitAndEverySingleMissingBit) {
  for (std::size_t bit = 0; bit < 512; ++bit) {
    Descriptor one;
    one.words[bit / 64] = std::uint64_t{1} << (bit % 64);
    ASSERT_EQ(hammingDistance(one, filled(0)), 1) << bit;
    ASSERT_EQ(hammingDistance(filled(~std::uint64_t{0}), one), 511) << bit;
  }
}

TEST(Hamming, EveryNumberOfBitsInRow) {
  Descriptor growing;
  for (int bits = 0; bits < 512; ++bits) {
    ASSERT_EQ(hammingDistance(growing, filled(0)), bits);
    growing.words[static_cast<std::size_t>(bits / 64)] |= std::uint64_t{1} << (bits % 64);
  }
}

TEST(Hamming, RandomPairsOfEveryDensityBothWaysAndInTheKernel) {
  std::mt19937_64 random(5);
  const Descriptor query = filled(random());
  std::vector<Descriptor> train;
  for (int k = 0; k < 2000; ++k) {
    Descriptor descriptor;
    for (auto& word : descriptor.words) {
      word = random();
      if (k % 3 == 1) word &= random() & random();
      if (k % 3 == 2) word |= random() | random();
    }
    train.push_back(descriptor);
  }
  std::vector<std::uint16_t> distances_bits(train.size() + 1, 9999);
  kernels::hammingDistancesScalar(query.words.data(), train.front().words.data(), train.size(),
                                  distances_bits.data());
  for (std::size_t k = 0; k < train.size(); ++k) {
    const int expected = countedBitByBit(query, train[k]);
    ASSERT_EQ(hammingDistance(query, train[k]), expected);
    ASSERT_EQ(hammingDistance(train[k], query), expected);
    ASSERT_EQ(distances_bits[k], expected);
  }
  EXPECT_EQ(distances_bits.back(), 9999) << "the kernel wrote beyond its count";
}

}  // namespace
}  // namespace ardrone_vslam
