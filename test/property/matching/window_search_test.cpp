// SPDX-License-Identifier: BSD-3-Clause
#include "matching/window_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ardrone_vslam/frame_tracker.hpp"
#include "matching/hamming.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

std::size_t drawBelow(std::size_t bound, std::mt19937_64& random) {
  return static_cast<std::size_t>(random() % bound);
}

using Places = std::vector<Eigen::Vector2f>;
using Descriptors = std::vector<Descriptor>;

float uniform(std::mt19937_64& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

/// With few different bits, so that ties abound.
Descriptors draw(std::size_t count, std::uint64_t mask, std::mt19937_64& random) {
  Descriptors descriptors(count);
  for (Descriptor& descriptor : descriptors) {
    for (auto& word : descriptor.words) word = random() & mask;
  }
  return descriptors;
}

struct Query {
  Descriptor descriptor;
  Eigen::Vector2f centre_px;
  float radius_px;
};

/// What WindowSearch promises, without cells.
struct BruteForce {
  std::vector<BestTwo> best;        // of each query
  std::vector<BestTwo> best_query;  // of each entry

  BruteForce(const Places& places_px, const Descriptors& descriptors,
             const std::vector<bool>& left_out, const std::vector<Query>& queries)
      : best(queries.size()), best_query(places_px.size()) {
    for (std::size_t q = 0; q < queries.size(); ++q) {
      const float radius2_px2 = queries[q].radius_px * queries[q].radius_px;
      for (std::size_t i = 0; i < places_px.size(); ++i) {
        if (!left_out.empty() && left_out[i]) continue;
        if (!((places_px[i] - queries[q].centre_px).squaredNorm() <= radius2_px2)) continue;
        const int bits = hammingDistance(queries[q].descriptor, descriptors[i]);
        best[q].offer(static_cast<int>(i), bits);
        best_query[i].offer(static_cast<int>(q), bits);
      }
    }
  }
};

void expectBruteForce(WindowSearch& search, const Places& places_px, const Descriptors& descriptors,
                      const std::vector<bool>& left_out, const std::vector<Query>& queries) {
  const BruteForce expected(places_px, descriptors, left_out, queries);
  search.build(places_px, descriptors, left_out);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const BestTwo best = search.search(queries[q].descriptor, queries[q].centre_px,
                                       queries[q].radius_px, static_cast<int>(q));
    ASSERT_EQ(best.index, expected.best[q].index) << q;
    ASSERT_EQ(best.distance_bits, expected.best[q].distance_bits) << q;
    ASSERT_EQ(best.second_distance_bits, expected.best[q].second_distance_bits) << q;
  }
  for (std::size_t i = 0; i < places_px.size(); ++i)
    ASSERT_EQ(search.nearestQuery(static_cast<int>(i)), expected.best_query[i].index) << i;
}

class WindowSearchForms : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(WindowSearchForms, EqualBruteForce) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    WindowSearch search(GetParam());  // one for all, as in a run
    for (int trial = 0; trial < 60; ++trial) {
      const auto count = static_cast<std::size_t>(random() % (trial % 4 == 0 ? 12 : 400));
      const float width_px = uniform(random, 1, 900);
      const bool whole = trial % 3 != 0;  // many at the circles' very edge
      const auto place = [&](float beyond_px) {
        Eigen::Vector2f p(uniform(random, -beyond_px, width_px + beyond_px),
                          uniform(random, -beyond_px, 300 + beyond_px));
        return whole ? Eigen::Vector2f(p.array().round()) : p;
      };
      Places places_px;
      for (std::size_t i = 0; i < count; ++i) {
        // Clustered, so that there are empty cells and full ones, and some are at one place.
        const bool again = !places_px.empty() && random() % 4 == 0;
        places_px.push_back(again ? places_px[drawBelow(places_px.size(), random)] : place(0));
      }
      const std::uint64_t mask = trial % 2 == 0 ? 3 : ~std::uint64_t{0};
      const Descriptors descriptors = draw(count, mask, random);
      std::vector<bool> left_out;
      if (trial % 5 == 0) {
        for (std::size_t i = 0; i < count; ++i) left_out.push_back(random() % 3 == 0);
      }
      std::vector<Query> queries;
      for (const Descriptor& descriptor : draw(150, mask, random)) {
        const float radius_px = uniform(random, 0, random() % 2 == 0 ? 30 : 200);
        queries.push_back({descriptor, place(100), whole ? std::round(radius_px) : radius_px});
      }
      expectBruteForce(search, places_px, descriptors, left_out, queries);
    }
  }
}

TEST_P(WindowSearchForms, MoreEntriesAndQueriesThan16BitsNumber) {
  constexpr std::size_t kEntries = 70'000;
  std::mt19937_64 random(3);
  Places places_px;
  for (std::size_t i = 0; i < kEntries; ++i)
    places_px.emplace_back(uniform(random, 0, 4000), uniform(random, 0, 3000));
  const Descriptors descriptors = draw(kEntries, 0xff, random);
  WindowSearch search(GetParam());
  search.build(places_px, descriptors);
  // Every entry is found at its place, by a query of its own number.
  for (std::size_t i = 0; i < kEntries; ++i) {
    const BestTwo best = search.search(descriptors[i], places_px[i], 0, static_cast<int>(i));
    ASSERT_EQ(best.distance_bits, 0);
    ASSERT_EQ(places_px[static_cast<std::size_t>(best.index)], places_px[i]);
  }
  ASSERT_EQ(search.nearestQuery(static_cast<int>(kEntries) - 1), static_cast<int>(kEntries) - 1);
  const std::vector<Query> queries{{descriptors[5], {2000, 1500}, 5000},
                                   {descriptors[69'000], {2000, 1500}, 1e6F},
                                   {descriptors[66'000], {100, 100}, 700}};
  expectBruteForce(search, places_px, descriptors, {}, queries);
}

TEST_P(WindowSearchForms, PlacesAndCirclesWithoutEndDoNoHarm) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  constexpr float kLargest = std::numeric_limits<float>::max();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  std::mt19937_64 random(4);
  const Descriptors descriptors = draw(5, ~std::uint64_t{0}, random);
  WindowSearch search(GetParam());
  EXPECT_EQ(search.search(descriptors[0], {1, 1}, 10, 0).index, -1) << "nothing is built";
  search.build({{10, 10}, {kNaN, 10}, {10, -kInfinite}, {kInfinite, kNaN}, {90, 10}}, descriptors);
  EXPECT_EQ(search.search(descriptors[4], {10, 10}, kLargest, 0).index, 4);
  EXPECT_EQ(search.search(descriptors[0], {10, 10}, kInfinite, 1).index, 0);
  EXPECT_EQ(search.search(descriptors[0], {10, kNaN}, 1000, 2).index, -1);
  EXPECT_EQ(search.search(descriptors[0], {10, 10}, kNaN, 3).index, -1);
  EXPECT_EQ(search.search(descriptors[0], {kLargest, -kLargest}, 5, 4).index, -1);
  for (const int lost : {1, 2, 3}) EXPECT_EQ(search.nearestQuery(lost), -1);
  search.build({{-kLargest, 0}, {kLargest, 0}}, {descriptors[0], descriptors[1]});
  EXPECT_EQ(search.search(descriptors[1], {kLargest, 0}, 1, 0).index, 1);
}

INSTANTIATE_TEST_SUITE_P(Sets, WindowSearchForms, ::testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& parameter) { return nameOf(parameter.param); });

/// The track ids by the definition: the best of all previous features within the radius, mutually.
class TracksByDefinition {
 public:
  explicit TracksByDefinition(const FrameTrackerConfig& config) : config_(config) {}

  std::vector<std::uint32_t> idsOf(const Places& places_px, const Descriptors& descriptors) {
    std::vector<Query> queries;
    for (std::size_t i = 0; i < places_px.size(); ++i)
      queries.push_back(
          {descriptors[i], places_px[i], static_cast<float>(config_.search_radius_px)});
    const BruteForce found(places_px_, descriptors_, {}, queries);
    const MatcherConfig accepted{config_.max_hamming_bits, config_.ratio, true};
    std::vector<std::uint32_t> ids;
    for (std::size_t i = 0; i < places_px.size(); ++i) {
      const BestTwo& best = found.best[i];
      const auto previous = static_cast<std::size_t>(best.index);
      const bool tracked =
          accept(best, accepted) && found.best_query[previous].index == static_cast<int>(i);
      ids.push_back(tracked ? ids_[previous] : next_id_++);
    }
    places_px_ = places_px;
    descriptors_ = descriptors;
    ids_ = ids;
    return ids;
  }

 private:
  FrameTrackerConfig config_;
  Places places_px_;
  Descriptors descriptors_;
  std::vector<std::uint32_t> ids_;
  std::uint32_t next_id_ = 1;
};

TEST(FrameTrackerTracks, EqualTheDefinition) {
  int carried_on = 0;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    FrameTrackerConfig config;
    config.search_radius_px = 40;
    FrameTracker tracker(config);
    TracksByDefinition definition(config);
    const Descriptors kinds = draw(60, ~std::uint64_t{0}, random);  // many look alike
    for (int frame = 0; frame < 12; ++frame) {
      ImageFeatures features;
      features.width_px = 640;
      features.height_px = 360;
      const std::size_t count = frame == 5 ? 0 : 100 + drawBelow(300, random);
      for (std::size_t i = 0; i < count; ++i) {
        features.pixel_px.emplace_back(static_cast<float>(random() % 640),
                                       static_cast<float>(random() % 360));
        features.descriptor.push_back(kinds[drawBelow(kinds.size(), random)]);
        for (int flips = static_cast<int>(random() % 60); flips > 0; --flips)
          features.descriptor.back().words[random() % 8] ^= std::uint64_t{1} << (random() % 64);
      }
      tracker.assign(features);
      ASSERT_EQ(features.track_id, definition.idsOf(features.pixel_px, features.descriptor));
      for (const std::uint16_t age_frames : features.age_frames) carried_on += age_frames > 0;
    }
  }
  EXPECT_GT(carried_on, 100) << "tracks are carried on at all";
}

}  // namespace
}  // namespace ardrone_vslam::test
