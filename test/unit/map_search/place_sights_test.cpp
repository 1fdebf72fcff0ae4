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

TEST(PlaceSights, ManyThatRecogniseHalfAreEnough) {
  const PlaceSight half = sightOf(0.6);
  EXPECT_FALSE(isFoundAtLast(std::vector<std::optional<PlaceSight>>(19, half)));
  EXPECT_TRUE(isFoundAtLast(std::vector<std::optional<PlaceSight>>(20, half)));
  EXPECT_FALSE(isFoundAtLast(std::vector<std::optional<PlaceSight>>(30, sightOf(0.45))));
  // Among them are some that say another place: as long as the mean is enough.
  std::vector<std::optional<PlaceSight>> sights(23, half);
  sights[5] = sights[15] = sightOf(1, 9);
  sights[10] = std::nullopt;
  EXPECT_TRUE(isFoundAtLast(sights));
  sights.resize(40, half);
  for (std::size_t i = 0; i < sights.size(); i += 5) sights[i] = sightOf(1, 9);
  EXPECT_FALSE(isFoundAtLast(sights));
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
