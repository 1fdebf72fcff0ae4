// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/ascent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ardrone_vslam {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Ascent, LeavesOutSingleStampsThatAreFarOff) {
  EXPECT_EQ(longestAscent({1, 2, 1000, 3, 4}, Ascent::kStrict), (Indices{0, 1, 3, 4}));
  EXPECT_EQ(longestAscent({1, 2, -1000, 3, 4}, Ascent::kStrict), (Indices{0, 1, 3, 4}));
  EXPECT_EQ(longestAscent({1, 1, 2, 2}, Ascent::kStrict).size(), 2U);
  EXPECT_EQ(longestAscent({1, 1, 2, 2}, Ascent::kMayRepeat), (Indices{0, 1, 2, 3}));
  EXPECT_TRUE(longestAscent({}, Ascent::kStrict).empty());
}

/// By trying all sub-sequences.
std::size_t longestByTrial(const std::vector<std::int64_t>& stamps, Ascent kind) {
  std::size_t longest = 0;
  for (unsigned chosen = 0; chosen < 1U << stamps.size(); ++chosen) {
    std::vector<std::int64_t> some;
    for (std::size_t i = 0; i < stamps.size(); ++i)
      if ((chosen >> i & 1U) != 0) some.push_back(stamps[i]);
    const bool repeats = std::adjacent_find(some.begin(), some.end()) != some.end();
    if (!std::is_sorted(some.begin(), some.end()) || (repeats && kind == Ascent::kStrict)) continue;
    longest = std::max(longest, some.size());
  }
  return longest;
}

TEST(Ascent, IsTheLongest) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::int64_t> stamps(8);
    for (std::int64_t& stamp : stamps) stamp = static_cast<std::int64_t>(random() % 6);
    for (const Ascent kind : {Ascent::kStrict, Ascent::kMayRepeat}) {
      const Indices kept = longestAscent(stamps, kind);
      EXPECT_EQ(kept.size(), longestByTrial(stamps, kind));
      EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
      std::vector<std::int64_t> ascent = stamps;
      keepAt(kept, ascent);
      EXPECT_EQ(ascent.size(), kept.size());
      EXPECT_TRUE(std::is_sorted(ascent.begin(), ascent.end()));
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
