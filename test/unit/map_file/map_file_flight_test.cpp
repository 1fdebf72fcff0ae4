// SPDX-License-Identifier: BSD-3-Clause
// The record of a flight in a map file: what cannot be is neither read nor written.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "unit/map_file/map_file_read_fixture.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

class MapFileFlightTest : public MapFileReadTest {
 protected:
  static constexpr std::size_t kFlightSection = 4;
  static constexpr std::size_t kCount = 88;  // where the number of keyframes is

  MapFileFlightTest() {
    map_.flight = smallFlight();
    writeMap(path_, map_);
    bytes_ = readFile(path_);
    sections_ = sectionsOf(bytes_);
  }
  /// Keyframes that are in a file after this was done to the record.
  std::size_t writtenAfter(const std::function<void(FlightRecord&)>& change) {
    SavedMap map = map_;
    change(map.flight);
    EXPECT_EQ(writeMap(path_, map), 3U);
    return readMap(path_, WithFlight::kYes).flight.keyframes.size();
  }

  SavedMap map_ = smallMap();
};

TEST_F(MapFileFlightTest, WhatCannotBeIsLeftOutAndTheMapStays) {
  EXPECT_EQ(writtenAfter([](FlightRecord& /*flight*/) {}), 2U);
  const std::vector<std::function<void(FlightRecord&)>> faults{
      [](FlightRecord& f) { f.config.track_sigma_px = 0; },
      [](FlightRecord& f) { f.config.track_common_px = kNoNumber; },
      [](FlightRecord& f) { f.config.odometry.tilt_sigma_deg = -1; },
      [](FlightRecord& f) { f.config.odometry.extrinsics_sigma_deg = kNoNumber; },
      [](FlightRecord& f) { f.keyframes.change(0).stamp_ns = -1; },
      [](FlightRecord& f) { f.keyframes.change(1).stamp_ns = f.keyframes[0].stamp_ns; },
      [](FlightRecord& f) { f.keyframes.change(1).T_odom_base.translation().x() = kNoNumber; },
      [](FlightRecord& f) { f.keyframes.change(1).T_base_cam.linear() *= 2; },
      [](FlightRecord& f) { f.keyframes.change(0).focal_length_px = 0; },
      [](FlightRecord& f) { f.keyframes.change(1).way_variance_m2 = -1; },
      [](FlightRecord& f) { f.keyframes.change(1).way_m = kNoNumber; },
      [](FlightRecord& f) { f.keyframes.change(1).height_m = kNoNumber; },
      [](FlightRecord& f) { f.keyframes.change(0).floor = 2; },
      [](FlightRecord& f) { f.keyframes.change(1).floor = 2'000'000'000; },
      [](FlightRecord& f) { f.keyframes.change(0).views[0].bearing_cam *= 2; },
      [](FlightRecord& f) { f.keyframes.change(0).views[0].information_rad2(1, 1) = 0; },
      [](FlightRecord& f) { f.keyframes.change(1).passed[0].stamp_ns = f.keyframes[1].stamp_ns; },
      [](FlightRecord& f) { f.keyframes.change(0).passed.resize(1); },
      [](FlightRecord& f) { f.keyframes.change(1).passed[0].T_odom_base.linear()(0, 0) = 7; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) EXPECT_EQ(writtenAfter(faults[i]), 0U) << i;
}

TEST_F(MapFileFlightTest, ExtrinsicsThatAreEstimatedComeBehind) {
  map_.flight.config.odometry.extrinsics_sigma_deg = 0.25;
  writeMap(path_, map_);
  EXPECT_EQ(readFile(path_).size(), bytes_.size() + 8);
  EXPECT_EQ(readMap(path_, WithFlight::kYes).flight.config.odometry.extrinsics_sigma_deg, 0.25);
  EXPECT_EQ(readMap(path_, WithFlight::kYes).flight.keyframes.size(), 2U);
  auto sections = sections_;  // a file without them
  ByteWriter bytes;
  bytes.f64(-1);
  sections[kFlightSection].payload += bytesOf(bytes);
  EXPECT_NE(faultOfSections(sections).find("the noise of the extrinsics is negative"),
            std::string::npos);
}

TEST_F(MapFileFlightTest, WhatCannotBeIsRefusedByName) {
  ByteWriter bytes;
  bytes.f64(kNoNumber);
  EXPECT_EQ(faultOfChange(kFlightSection, 0, bytes),
            "section keyf cannot be right: the noise of the flight is negative, or not finite; use "
            "another copy, or make the map anew");
  bytes.clear();
  bytes.i64(0);
  EXPECT_EQ(faultOfChange(kFlightSection, kCount + 4, bytes), "");  // the first is earlier still
  bytes.clear();
  bytes.i64(960'000'000'000);
  EXPECT_NE(faultOfChange(kFlightSection, kCount + 4, bytes)
                .find("the keyframe of 950000000000 ns does not follow the one before"),
            std::string::npos);
}

TEST_F(MapFileFlightTest, CountsThatAreTooLargeTakeNoMemory) {
  for (const std::size_t at : {kCount, kCount + 4 + 336, kCount + 4 + 340, kCount + 4 + 344}) {
    ByteWriter bytes;
    bytes.u32(0xFFFFFFFFU);
    EXPECT_NE(faultOfChange(kFlightSection, at, bytes), "") << at;
  }
  auto sections = sections_;
  sections[kFlightSection].payload.resize(kCount);
  EXPECT_NE(faultOfSections(sections), "");
  sections = sections_;
  sections[kFlightSection].payload += '\0';
  EXPECT_NE(faultOfSections(sections), "");
}

}  // namespace
}  // namespace ardrone_vslam::test
