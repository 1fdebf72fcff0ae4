// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/telemetry.hpp"

#include <gtest/gtest.h>

#include <set>

#include "map/landmark_map.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam::test {
namespace {

using Datagram = std::array<std::uint8_t, Telemetry::kBytes>;

struct Read {
  std::uint64_t total = 0, round = 0, features = 0, landmarks = 0;
  std::vector<std::uint64_t> ids;
};

Read readDatagram(const Datagram& datagram, std::size_t size) {
  EXPECT_EQ(vslam_check(datagram.data(), size, VSLAM_KIND_TELEMETRY, size), VSLAM_GOOD);
  Read r;
  const std::uint8_t* at = datagram.data() + VSLAM_HEADER_BYTES + 8;
  at = vslam_get(at, &r.total, 4);
  at = vslam_get(at, &r.round, 4);
  at = vslam_get(at, &r.features, 2);
  at = vslam_get(at, &r.landmarks, 2) + r.features * Telemetry::kFeatureBytes;
  for (std::uint64_t i = 0; i < r.landmarks; ++i, at += Telemetry::kLandmarkBytes)
    vslam_get(at, &r.ids.emplace_back(), 4);
  EXPECT_EQ(at + VSLAM_CRC_BYTES, datagram.data() + size);
  return r;
}

ImageFeatures someFeatures(std::size_t count) {
  ImageFeatures features;
  features.stamp_ns = 1;
  for (std::size_t i = 0; i < count; ++i) {
    features.pixel_px.emplace_back(100.25F, 50.F);
    features.age_frames.push_back(static_cast<std::uint16_t>(i));
  }
  return features;
}

TEST(TelemetryTest, IsBoundedAndEveryLandmarkComesWithinARound) {
  LandmarkMap map{LandmarkMapConfig{}};
  for (int i = 0; i < 1000; ++i) {
    Landmark landmark;
    landmark.last_seen_ns = i < 5 ? 0 : 1;  // those of one picture
    map.add(landmark);
  }
  ImageFeatures features = someFeatures(600);
  Telemetry telemetry;
  Datagram datagram;
  std::set<std::uint64_t> ids;
  for (int i = 0; i < 100; ++i) {
    features.stamp_ns = i + 1;
    const std::size_t size = telemetry.write(features, map.all(), datagram);
    ASSERT_LE(size, Telemetry::kBytes);
    const Read r = readDatagram(datagram, size);
    EXPECT_EQ(r.total, 1000U);
    EXPECT_EQ(r.features, Telemetry::kMostFeatures);
    EXPECT_GT(r.landmarks, 40U);
    ids.insert(r.ids.begin(), r.ids.end());
    if (r.round == 1) break;
  }
  EXPECT_EQ(ids.size(), 1000U);
}

TEST(TelemetryTest, WhatWasJustSeenComesFirst) {
  LandmarkMap map{LandmarkMapConfig{}};
  for (int i = 0; i < 1000; ++i) map.add(Landmark{});
  Telemetry telemetry;
  Datagram datagram;
  telemetry.write(someFeatures(10), map.all(), datagram);
  map.atPlace(900).last_seen_ns = 2;
  ImageFeatures features = someFeatures(10);
  features.stamp_ns = 2;
  const Read r = readDatagram(datagram, telemetry.write(features, map.all(), datagram));
  ASSERT_FALSE(r.ids.empty());
  EXPECT_EQ(r.ids.front(), map.all()[900].id);
}

TEST(TelemetryTest, NothingIsADatagramToo) {
  Telemetry telemetry;
  Datagram datagram;
  const LandmarkMap map{LandmarkMapConfig{}};
  const Read r = readDatagram(datagram, telemetry.write(ImageFeatures{}, map.all(), datagram));
  EXPECT_EQ(r.features + r.landmarks + r.total, 0U);
}

}  // namespace
}  // namespace ardrone_vslam::test
