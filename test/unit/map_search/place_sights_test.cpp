// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/place_sights.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

/// Of an image that shows landmarks 3 m away, on a flight that began so far along x.
PlaceSight sightOf(double cover, double began_x_m = 5, double heading_rad = 0.3) {
  PlaceSight sight;
  sight.entry.T_loaded_flight.linear() = rotationAboutZ(heading_rad);
  sight.entry.T_loaded_flight.translation().x() = began_x_m;
  sight.distance_m = 3;
  sight.cover = cover;
  return sight;
}

/// Whether the last of these images is where the flight is found, and none before it.
bool isFoundAtLast(const std::vector<std::optional<PlaceSight>>& sights) {
  PlaceSights place;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (place.add(sights[i])) return i + 1 == sights.size();
  }
  return false;
}

TEST(PlaceSights, FourThatAgreeAreNeeded) {
  const PlaceSight sight = sightOf(0.8);
  EXPECT_FALSE(isFoundAtLast({sight, sight, sight}));
  EXPECT_TRUE(isFoundAtLast({sight, sight, sight, sight}));
  EXPECT_TRUE(isFoundAtLast({sight, sightOf(0.8, 5.2), sightOf(0.8, 5, 0.35), sight}));
  EXPECT_FALSE(isFoundAtLast({sight, sightOf(0.8, 5.4), sight, sight}));      // another place
  EXPECT_FALSE(isFoundAtLast({sight, sightOf(0.8, 5, 0.45), sight, sight}));  // another heading
}

TEST(PlaceSights, ThoseThatRecogniseLittleSpeakAgainstThePlace) {
  const PlaceSight good = sightOf(0.8);
  const PlaceSight better = sightOf(1);
  const PlaceSight poor = sightOf(0.4);
  EXPECT_FALSE(isFoundAtLast({good, poor, good, good, good}));
  EXPECT_TRUE(isFoundAtLast({better, poor, better, better, good}));
  EXPECT_TRUE(isFoundAtLast({poor, poor, poor, good, good, good, good}));  // from afar, at first
  EXPECT_FALSE(isFoundAtLast({good, good, good, good, good, poor}));       // it had been before
  EXPECT_FALSE(isFoundAtLast({better, better, better, better, poor}));
}

TEST(PlaceSights, SoDoThoseThatSayAnotherPlaceOrNone) {
  const PlaceSight good = sightOf(0.9);
  EXPECT_FALSE(isFoundAtLast({good, std::nullopt, good, good, good}));
  EXPECT_FALSE(isFoundAtLast({good, sightOf(1, 9), good, good, good}));
}

TEST(PlaceSights, WhatWasLongAgoIsForgotten) {
  std::vector<std::optional<PlaceSight>> sights(3, sightOf(1));
  sights.resize(11);
  sights.resize(14, sightOf(1));
  EXPECT_FALSE(isFoundAtLast(sights));
  sights.push_back(sightOf(1));
  EXPECT_TRUE(isFoundAtLast(sights));
}

/// As many looks along a way of 4 cm each.
std::vector<std::optional<PlaceSight>> along(std::size_t looks, double cover) {
  std::vector<std::optional<PlaceSight>> sights(looks, sightOf(cover));
  for (std::size_t i = 0; i < looks; ++i)
    sights[i]->camera_flight.x() = 0.04 * static_cast<double>(i);
  return sights;
}

TEST(PlaceSights, ManyThatRecogniseHalfAreEnoughAlongSomeWay) {
  EXPECT_FALSE(isFoundAtLast(along(19, 0.52)));
  EXPECT_TRUE(isFoundAtLast(along(20, 0.52)));
  EXPECT_FALSE(isFoundAtLast(along(40, 0.48)));
  EXPECT_FALSE(isFoundAtLast(std::vector<std::optional<PlaceSight>>(40, sightOf(0.7))))
      << "a camera that stands before what is alike";
  auto sights = along(20, 0.7);
  sights.back()->cover = 0.4;
  EXPECT_FALSE(isFoundAtLast(sights)) << "the place is that of the newest one";
  sights = along(24, 0.6);
  for (const std::size_t i : {3U, 9U, 15U}) sights[i]->cover = 0.05;  // they count, but say little
  EXPECT_TRUE(isFoundAtLast({sights.begin(), sights.begin() + 20}));
  for (const std::size_t i : {4U, 10U, 16U, 18U}) sights[i] = sightOf(1, 9);
  EXPECT_FALSE(isFoundAtLast(sights)) << "others say another place";
}

TEST(PlaceSights, TheLongRunIsOf32Looks) {
  auto sights = along(33, 0.85);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (i % 5 == 1 || i % 5 == 3) sights[i] = std::nullopt;
  }
  EXPECT_FALSE(isFoundAtLast(sights)) << "20 with a place, the first of them 33 looks ago";
  sights.erase(sights.begin() + 1);
  EXPECT_TRUE(isFoundAtLast(sights));
}

TEST(PlaceSights, InTheFlightsOwnMapTheLongRunCountsToo) {
  PlaceSights place;
  const auto sights = along(20, 0.55);
  for (std::size_t i = 0; i < sights.size(); ++i)
    EXPECT_EQ(place.add(sights[i], true), i + 1 == sights.size()) << i;
}

TEST(PlaceSights, LessIsNeededWhereTheFlightIsKnownToBeInTheMap) {
  PlaceSights place;
  EXPECT_FALSE(place.add(sightOf(0.65), true));
  EXPECT_FALSE(place.add(sightOf(0.65), true));
  EXPECT_FALSE(place.add(sightOf(0.45), true));
  EXPECT_FALSE(place.add(sightOf(0.6), true));  // the mean is not enough
  EXPECT_TRUE(place.add(sightOf(0.7), true));
}

TEST(PlaceSights, ClearForgetsAll) {
  PlaceSights place;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(place.add(sightOf(1)));
  place.clear();
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(place.add(sightOf(1)));
  EXPECT_TRUE(place.add(sightOf(1)));
}

}  // namespace
}  // namespace ardrone_vslam
