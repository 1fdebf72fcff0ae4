// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/telemetry_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "onboard/telemetry_flight.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam::test {
namespace {

std::vector<std::uint32_t> idsOf(const Landmarks& landmarks) {
  std::vector<std::uint32_t> ids;
  ids.reserve(landmarks.size());
  for (const Landmark& landmark : landmarks) ids.push_back(landmark.id);
  return ids;
}

std::vector<std::uint32_t> idsOf(const LandmarkMap& map) {
  std::vector<std::uint32_t> ids = idsOf(map.all());
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST(TelemetryReader, WhatIsWrittenComesBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    TelemetryFlight flight(seed);
    flight.grow(static_cast<int>(flight.random() % 22));  // just seen, all go into one datagram
    const Bytes datagram = flight.next(flight.random() % 100);
    TelemetryReader reader;
    ASSERT_TRUE(reader.read(datagram.data(), datagram.size())) << seed;
    const ImageFeatures& features = reader.features();
    EXPECT_EQ(features.stamp_ns, flight.features.stamp_ns);
    ASSERT_EQ(features.size(), flight.features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
      EXPECT_LE((features.pixel_px[i] - flight.features.pixel_px[i]).cwiseAbs().maxCoeff(),
                1 / 32.F);
      EXPECT_EQ(features.age_frames[i], std::min<int>(flight.features.age_frames[i], 255));
    }
    EXPECT_EQ(reader.landmarksOnDrone(), flight.map.size());
    ASSERT_EQ(idsOf(reader.landmarks()), idsOf(flight.map)) << seed;
    for (const Landmark& landmark : reader.landmarks()) {
      const Landmark& sent = *flight.map.find(landmark.id);
      EXPECT_LT((landmark.position_map - sent.position_map).norm(), 1e-5);
      EXPECT_EQ(landmark.sigma_m, static_cast<float>(sent.sigma_m));
    }
  }
}

TEST(TelemetryReader, TheWholeMapIsThereAfterARound) {
  TelemetryFlight flight(1);
  flight.grow(1500);
  TelemetryReader reader;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(flight.fly(reader));
  EXPECT_EQ(idsOf(reader.landmarks()), idsOf(flight.map));
}

/// The drone's map changes all the time, also in its order, and datagrams are lost: at its end all
/// that is there has come, and what was removed is forgotten.
TEST(TelemetryReader, FollowsAMapThatChangesThroughLosses) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    TelemetryFlight flight(seed);
    flight.grow(600);
    TelemetryReader reader;
    for (int i = 0; i < 300; ++i) {
      flight.grow(static_cast<int>(flight.random() % 5));
      flight.shrink(static_cast<int>(flight.random() % 5));
      const Bytes datagram = flight.next(50);
      if (flight.random() % 10 == 0) continue;  // lost
      ASSERT_TRUE(reader.read(datagram.data(), datagram.size()));
    }
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(flight.fly(reader));
    EXPECT_EQ(idsOf(reader.landmarks()), idsOf(flight.map)) << seed;
  }
}

TEST(TelemetryReader, ALandmarkThatIsThereIsNotForgottenWithoutLosses) {
  TelemetryFlight flight(3);
  flight.grow(400);
  TelemetryReader reader;
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(flight.fly(reader));
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(flight.fly(reader));
    EXPECT_EQ(reader.size(), flight.map.size()) << i;
  }
}

TEST(TelemetryReader, AnEmptyMapAndOneThatBeganAnewForgetAll) {
  TelemetryFlight flight(4);
  flight.grow(20);
  TelemetryReader reader;
  ASSERT_TRUE(flight.fly(reader));
  EXPECT_EQ(reader.size(), 20U);
  flight.shrink(20);
  ASSERT_TRUE(flight.fly(reader));
  EXPECT_EQ(reader.size(), 0U);

  TelemetryFlight longer(5);
  longer.grow(30);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(longer.fly(reader));
  TelemetryFlight again(6);  // its rounds begin at 0
  again.grow(3);
  ASSERT_TRUE(again.fly(reader));
  EXPECT_EQ(reader.size(), 3U);
  reader.forgetLandmarks();
  EXPECT_TRUE(reader.landmarks().empty());
}

TEST(TelemetryReader, ContentsThatCannotBeAreRefusedAsAWhole) {
  TelemetryFlight flight(7);
  flight.grow(10);
  const Bytes good = flight.next(20);
  TelemetryReader reader;
  ASSERT_TRUE(reader.read(good.data(), good.size()));
  const auto refuses = [&](std::size_t at, std::initializer_list<std::uint8_t> bytes) {
    Bytes bad = good;
    for (const std::uint8_t byte : bytes) bad.at(at++) = byte;
    vslam_put_crc(bad.data(), bad.size());
    return !reader.read(bad.data(), bad.size());
  };
  EXPECT_TRUE(refuses(28, {21, 0}));                          // a feature more than there are
  EXPECT_TRUE(refuses(30, {0xFF, 0xFF}));                     // landmarks beyond the end
  EXPECT_TRUE(refuses(12 + 7, {0x80}));                       // a stamp before all time
  EXPECT_TRUE(refuses(32 + 20 * 5 + 4, {0, 0, 0xC0, 0x7F}));  // a landmark at NaN
  EXPECT_EQ(reader.size(), 10U);
  EXPECT_EQ(reader.features().size(), 20U);
  std::array<std::uint8_t, 16> tiny{};
  vslam_put_header(tiny.data(), VSLAM_KIND_TELEMETRY, tiny.size(), 1);
  vslam_put_crc(tiny.data(), tiny.size());
  EXPECT_FALSE(reader.read(tiny.data(), tiny.size()));
}

TEST(TelemetryReader, NoMoreLandmarksAreKeptThanAnyDroneHas) {
  TelemetryFlight flight(8);
  flight.grow(20);
  Bytes datagram = flight.next(0);
  TelemetryReader reader;
  std::uint32_t id = 0;
  const std::size_t count =
      (datagram.size() - Telemetry::kFixedBytes - VSLAM_CRC_BYTES) / Telemetry::kLandmarkBytes;
  ASSERT_GT(count, 0U);
  const auto sendOthers = [&] {  // of the same round
    for (std::size_t i = 0; i < count; ++i)
      vslam_put(datagram.data() + Telemetry::kFixedBytes + i * Telemetry::kLandmarkBytes, ++id, 4);
    vslam_put_crc(datagram.data(), datagram.size());
    return reader.read(datagram.data(), datagram.size());
  };
  const std::size_t most = TelemetryReader::kMostLandmarks / count;
  for (std::size_t i = 0; i < most; ++i) ASSERT_TRUE(sendOthers()) << i;
  EXPECT_EQ(reader.size(), most * count);
  EXPECT_TRUE(sendOthers());
  EXPECT_EQ(reader.size(), count) << "what comes is true again, what was there is forgotten";
}

}  // namespace
}  // namespace ardrone_vslam::test
