// SPDX-License-Identifier: BSD-3-Clause
#include "matching/match_acceptance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace ardrone_vslam {
namespace {

TEST(BestTwo, DoesNotDependOnTheOrderOfTheOffers) {
  std::array<std::array<int, 2>, 5> offers{
      {{0, 40}, {1, 30}, {2, 30}, {3, 50}, {4, 31}}};  // index, distance
  std::sort(offers.begin(), offers.end());
  do {
    BestTwo best;
    for (const auto& offer : offers) best.offer(offer[0], offer[1]);
    ASSERT_EQ(best.index, 1) << "the lower index of the two nearest";
    ASSERT_EQ(best.distance_bits, 30);
    ASSERT_EQ(best.second_distance_bits, 30);
  } while (std::next_permutation(offers.begin(), offers.end()));
}

TEST(BestTwo, NothingAndOneCandidate) {
  BestTwo best;
  EXPECT_FALSE(accept(best, MatcherConfig{512, 1.0, false}));
  best.offer(7, 512);
  EXPECT_EQ(best.index, 7) << "even the largest distance is a candidate";
  EXPECT_EQ(best.second_distance_bits, kNoDistance_bits);
  EXPECT_TRUE(accept(best, MatcherConfig{512, 0.1, false}))
      << "a single candidate has no rival to be compared with";
}

TEST(Accept, LargestDistanceIsIncluded) {
  const BestTwo best{0, 90, 400};
  EXPECT_TRUE(accept(best, MatcherConfig{90, 0.85, true}));
  EXPECT_FALSE(accept(best, MatcherConfig{89, 0.85, true}));
}

TEST(Accept, RatioIsStrict) {
  EXPECT_FALSE(accept(BestTwo{0, 50, 100}, MatcherConfig{90, 0.5, true}));
  EXPECT_TRUE(accept(BestTwo{0, 49, 100}, MatcherConfig{90, 0.5, true}));
  EXPECT_FALSE(accept(BestTwo{0, 0, 0}, MatcherConfig{90, 0.99, true}))
      << "two equal candidates are ambiguous";
}

TEST(Accept, RatioOfOneIsOff) {
  EXPECT_TRUE(accept(BestTwo{0, 50, 50}, MatcherConfig{90, 1.0, true}));
  EXPECT_TRUE(accept(BestTwo{0, 0, 0}, MatcherConfig{90, 1.0, true}));
}

}  // namespace
}  // namespace ardrone_vslam
