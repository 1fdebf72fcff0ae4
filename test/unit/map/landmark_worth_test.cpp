// SPDX-License-Identifier: BSD-3-Clause
// What a full map can spare.
#include "ardrone_vslam/landmark_worth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kWorthSecond_ns = 1'000'000'000;

/// Seen from 2 m, well known, in a cell of its own.
Landmark landmarkOf(std::uint32_t id) {
  Landmark landmark;
  landmark.id = id;
  landmark.position_map = {static_cast<double>(id), 0, 0};
  landmark.seen_distance_m = 2;
  landmark.sigma_m = 0.01F;
  landmark.times_seen = 10;
  landmark.last_seen_ns = 1000 * kWorthSecond_ns;
  return landmark;
}

std::vector<Landmark> mapOf(std::uint32_t count) {
  std::vector<Landmark> map;
  for (std::uint32_t id = 1; id <= count; ++id) map.push_back(landmarkOf(id));
  return map;
}

TEST(LandmarkWorth, TheLessUsedTheOlderAndTheLessKnownGoFirst) {
  std::vector<Landmark> map = mapOf(20);
  map[4].times_seen = 2;
  map[7].last_seen_ns -= 600 * kWorthSecond_ns;
  map[11].sigma_m = 0.1F;
  std::vector<std::uint32_t> gone = leastWorth(map, 3);
  std::sort(gone.begin(), gone.end());
  EXPECT_EQ(gone, (std::vector<std::uint32_t>{5, 8, 12}));
}

TEST(LandmarkWorth, UseOutweighsAge) {
  // What is circled: each place was seen long ago when the drone is about to be there again.
  std::vector<Landmark> map = mapOf(100);
  for (std::size_t i = 0; i < 100; ++i) {
    map[i].last_seen_ns -= static_cast<std::int64_t>(99 - i) * kWorthSecond_ns / 4;
    map[i].times_seen = i % 2 == 0 ? 30 : 1;
  }
  for (const std::uint32_t id : leastWorth(map, 50)) EXPECT_EQ(map[id - 1].times_seen, 1) << id;
}

TEST(LandmarkWorth, WhereThereAreManyTheyGoBeforeALoneOne) {
  std::vector<Landmark> map = mapOf(40);
  for (std::size_t i = 0; i < 20; ++i)
    map[i].position_map = {-5.03, 0.001 * static_cast<double>(i), 0};
  map[6].times_seen = 20;  // the best of them
  map[30].times_seen = 3;  // alone
  const std::vector<std::uint32_t> gone = leastWorth(map, 15);
  for (const std::uint32_t id : gone) EXPECT_LE(id, 20U);
  EXPECT_EQ(leastWorth(map, 20).size(), 20U);
  std::size_t of_the_place = 0;
  for (const std::uint32_t id : leastWorth(map, 30)) of_the_place += id <= 20 ? 1 : 0;
  EXPECT_LT(of_the_place, 20U) << "the place is lost whole";
}

TEST(LandmarkWorth, ANewPlaceIsMappedThoughTheMapIsFull) {
  // An hour before 200 of one wall, 4 to a cell; then a new wall, of which each was seen 6 times.
  std::vector<Landmark> map = mapOf(200);
  for (std::size_t i = 0; i < 200; ++i) {
    map[i].position_map = {0, static_cast<double>(i / 4), 0};
    map[i].times_seen = 60'000;
    map[i].last_seen_ns -= 60 * kWorthSecond_ns;
  }
  for (std::uint32_t id = 201; id <= 240; ++id) {
    map.push_back(landmarkOf(id));
    map.back().position_map = {50, static_cast<double>(id), 0};
    map.back().times_seen = 6;
  }
  std::size_t of_the_new = 0;
  for (const std::uint32_t id : leastWorth(map, 60)) of_the_new += id > 200 ? 1 : 0;
  EXPECT_LT(of_the_new, 10U);
}

TEST(LandmarkWorth, OfEqualsTheLowestIdsGoAndNoMoreThanThereAre) {
  EXPECT_EQ(leastWorth(mapOf(5), 2), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(leastWorth(mapOf(3), 9).size(), 3U);
  EXPECT_TRUE(leastWorth({}, 4).empty());
}

}  // namespace
}  // namespace ardrone_vslam
