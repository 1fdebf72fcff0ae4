// SPDX-License-Identifier: BSD-3-Clause
#include "matching/descriptor_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <random>
#include <tuple>
#include <vector>

namespace ardrone_vslam {

static bool operator==(const DescriptorMatch& a, const DescriptorMatch& b) {
  return std::tie(a.query, a.train, a.distance_bits, a.second_distance_bits) ==
         std::tie(b.query, b.train, b.distance_bits, b.second_distance_bits);
}
// NOLINTNEXTLINE(readability-identifier-naming): gtest calls it so
static void PrintTo(const DescriptorMatch& m, std::ostream* stream) {
  *stream << m.query << "-" << m.train << " (" << m.distance_bits << ", " << m.second_distance_bits
          << ")";
}

namespace {

using Descriptors = std::vector<Descriptor>;
using Matches = std::vector<DescriptorMatch>;
constexpr MatcherConfig kEverything{512, 1.0, false};

/// A descriptor with the first `bits` bits set: distances are differences of these numbers.
Descriptor withBits(int bits) {
  Descriptor descriptor;
  for (int k = 0; k < bits; ++k)
    descriptor.words[static_cast<std::size_t>(k / 64)] |= std::uint64_t{1} << (k % 64);
  return descriptor;
}
Descriptors allWithBits(const std::vector<int>& numbers) {
  Descriptors descriptors;
  for (const int bits : numbers) descriptors.push_back(withBits(bits));
  return descriptors;
}

/// The matches, which every instruction set must find.
Matches match(const Descriptors& query, const Descriptors& train, const MatcherConfig& config) {
  Matches matches;
  matchExact(query, train, config, matches, InstructionSet::kScalar);
  for (const InstructionSet set : supportedInstructionSets()) {
    Matches again;
    matchExact(query, train, config, again, set);
    EXPECT_EQ(again, matches) << nameOf(set);
  }
  return matches;
}

int distance(const Descriptor& a, const Descriptor& b) {
  std::size_t bits = 0;
  for (std::size_t w = 0; w < 8; ++w) bits += std::bitset<64>(a.words[w] ^ b.words[w]).count();
  return static_cast<int>(bits);
}

/// @return (distance, index) of all candidates, nearest first, equal ones by index
std::vector<std::pair<int, int>> ranked(const Descriptor& descriptor,
                                        const Descriptors& candidates) {
  std::vector<std::pair<int, int>> ranking;
  for (const auto& candidate : candidates) {
    ranking.emplace_back(distance(descriptor, candidate), static_cast<int>(ranking.size()));
  }
  std::sort(ranking.begin(), ranking.end());
  return ranking;
}

Matches oracle(const Descriptors& query, const Descriptors& train, const MatcherConfig& config) {
  Matches matches;
  for (std::size_t q = 0; q < query.size() && !train.empty(); ++q) {
    const auto ranking = ranked(query[q], train);
    const auto [best_bits, best] = ranking[0];
    const int number = static_cast<int>(q);
    if (best_bits > config.max_hamming_bits) continue;
    if (ranking.size() > 1 && config.ratio < 1.0 && !(best_bits < config.ratio * ranking[1].first))
      continue;
    if (config.cross_check &&
        ranked(train[static_cast<std::size_t>(best)], query)[0].second != number)
      continue;
    matches.push_back(
        {number, best, best_bits, ranking.size() > 1 ? ranking[1].first : kNoDistance_bits});
  }
  return matches;
}

/// Descriptors that differ in few of few bits, so that equal distances abound, or in many.
Descriptors randomDescriptors(std::size_t count, std::uint64_t mask, std::mt19937_64& random) {
  Descriptors descriptors(count);
  for (auto& descriptor : descriptors) {
    for (auto& word : descriptor.words) word = random() & mask;
  }
  return descriptors;
}

TEST(MatchExact, EqualsTheOracleOnEverySizeAndConfiguration) {
  const auto drawn_seed = std::random_device{}();
  for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{drawn_seed}}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    for (const std::uint64_t mask : {std::uint64_t{0x8000000000000001}, ~std::uint64_t{0}}) {
      for (const auto& [queries, trains] : {std::make_pair(1, 1),
                                            {1, 2},
                                            {2, 1},
                                            {7, 5},
                                            {40, 255},
                                            {40, 256},
                                            {40, 257},
                                            {90, 600},
                                            {300, 40}}) {
        const auto query = randomDescriptors(static_cast<std::size_t>(queries), mask, random);
        const auto train = randomDescriptors(static_cast<std::size_t>(trains), mask, random);
        for (const bool cross_check : {false, true}) {
          for (const MatcherConfig& config :
               {MatcherConfig{512, 1.0, cross_check}, MatcherConfig{512, 0.95, cross_check},
                MatcherConfig{3, 1.0, cross_check}, MatcherConfig{230, 0.97, cross_check}}) {
            ASSERT_EQ(match(query, train, config), oracle(query, train, config))
                << queries << " x " << trains;
          }
        }
      }
    }
  }
}

TEST(MatchExact, EmptySetsGiveNoMatchAndClearTheResult) {
  const auto some = allWithBits({1, 2});
  for (const auto& [query, train] : {std::make_pair(Descriptors{}, some), {some, {}}, {{}, {}}}) {
    Matches matches(3);
    matchExact(query, train, kEverything, matches);
    EXPECT_TRUE(matches.empty());
  }
}

TEST(MatchExact, SingleTrainDescriptorHasNoSecond) {
  EXPECT_EQ(match(allWithBits({10}), allWithBits({30}), MatcherConfig{20, 0.1, true}),
            (Matches{{0, 0, 20, kNoDistance_bits}}));
  EXPECT_TRUE(match(allWithBits({10}), allWithBits({30}), MatcherConfig{19, 0.1, true}).empty());
}

TEST(MatchExact, EquallyNearTrainDescriptorsGoByTheLowestIndex) {
  EXPECT_EQ(match(allWithBits({100}), allWithBits({300, 110, 90, 110}), kEverything),
            (Matches{{0, 1, 10, 10}}));
}

TEST(MatchExact, CrossCheckKeepsTheLowestOfEquallyNearQueries) {
  const auto query = allWithBits({110, 90, 100, 300});
  const auto train = allWithBits({100, 500});
  EXPECT_EQ(match(query, train, MatcherConfig{512, 1.0, true}), (Matches{{2, 0, 0, 400}}));
  EXPECT_EQ(match(allWithBits({110, 90}), train, MatcherConfig{512, 1.0, true}),
            (Matches{{0, 0, 10, 390}}));
}

TEST(MatchExact, RatioComparesWithTheSecondNearest) {
  const auto train = allWithBits({100, 160});
  EXPECT_EQ(match(allWithBits({120}), train, MatcherConfig{90, 0.51, false}),
            (Matches{{0, 0, 20, 40}}));
  EXPECT_TRUE(match(allWithBits({120}), train, MatcherConfig{90, 0.5, false}).empty());
}

// Work areas are tiles of 256 train descriptors: a better one in a later tile must replace the
// judgement made before.
TEST(MatchExact, BestMayLieInAnyTile) {
  for (const std::size_t place : {0U, 255U, 256U, 511U, 512U, 699U}) {
    Descriptors train(700, withBits(400));
    train[place] = withBits(51);
    const auto matches = match(allWithBits({300, 50}), train, MatcherConfig{512, 0.99, true});
    ASSERT_EQ(matches, (Matches{{1, static_cast<int>(place), 1, 350}})) << place;
  }
}

// The kernels number queries with 16 bits.
TEST(MatchExact, CrossCheckHoldsAmongMoreThan65536Queries) {
  Descriptors query(65536 + 40, withBits(400));
  query[30] = withBits(100);
  query[65536 + 7] = withBits(201);
  query[65536 + 30] = withBits(100);  // as near as 30, which comes first
  const auto train = allWithBits({200, 101});
  EXPECT_EQ(match(query, train, MatcherConfig{100, 1.0, true}),
            (Matches{{30, 1, 1, 100}, {65536 + 7, 0, 1, 100}}));
}

}  // namespace
}  // namespace ardrone_vslam
