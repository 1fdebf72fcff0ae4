// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/height_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/odometry_states.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

RangeReading reading(std::int64_t stamp_ms, double range_m) {
  return {stamp_ms * kMillisecond_ns, range_m, 0.2, 4};
}

/// Nose to the left, tilted.
OdometryState tiltedAt(std::int64_t stamp_ms, double roll_rad = 0, double pitch_rad = 0) {
  OdometryState state = test::odometryAt(stamp_ms * kMillisecond_ns, {0, 0, 0}, 0.7);
  state.T_odom_base.rotate(Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()));
  return state;
}

HeightInputConfig withRange() {
  HeightInputConfig config;
  config.use_range = true;
  return config;
}

TEST(HeightInput, RangesAreInterpolatedAtTheStamp) {
  HeightInput input(withRange(), 10);
  input.push(reading(1000, 1.0));
  input.push(reading(1050, 1.2));
  EXPECT_NEAR(*input.at(tiltedAt(1000)), 1.0, 1e-12);
  EXPECT_NEAR(*input.at(tiltedAt(1025)), 1.1, 1e-12);
  EXPECT_NEAR(*input.at(tiltedAt(1050)), 1.2, 1e-12);
}

TEST(HeightInput, AtTheEndsTheNearestCountsForAsLongAsAHoleMayBe) {
  HeightInput input(withRange(), 10);
  EXPECT_FALSE(input.at(tiltedAt(1000)));
  input.push(reading(1000, 1.0));
  EXPECT_TRUE(input.at(tiltedAt(901)));
  EXPECT_FALSE(input.at(tiltedAt(899)));
  EXPECT_TRUE(input.at(tiltedAt(1099)));
  EXPECT_FALSE(input.at(tiltedAt(1101)));
  input.push(reading(1300, 1.2));
  EXPECT_FALSE(input.at(tiltedAt(1050))) << "in a hole";
  EXPECT_TRUE(input.at(tiltedAt(1300)));
}

TEST(HeightInput, TheBeamIsAsLongAsTheDroneIsTilted) {
  HeightInput input(withRange(), 10);
  input.push(reading(1000, 2.0));
  const double roll_rad = 0.2;
  const double pitch_rad = -0.15;
  EXPECT_NEAR(*input.at(tiltedAt(1000, roll_rad, pitch_rad)),
              2.0 * std::cos(roll_rad) * std::cos(pitch_rad), 1e-12);
  EXPECT_EQ(input.tilted(), 0U);
  EXPECT_FALSE(input.at(tiltedAt(1000, 0.4, 0)));
  EXPECT_FALSE(input.at(tiltedAt(1000, 3.1, 0))) << "upside down";
  EXPECT_EQ(input.tilted(), 2U);
}

TEST(HeightInput, AVerticalReadingIsTheHeightWhateverTheTilt) {
  HeightInputConfig config;
  config.use_navdata_height = true;
  HeightInput input(config, 10);
  RangeReading height = reading(1000, 2.0);
  height.is_vertical = true;
  EXPECT_EQ(input.push(height), HeightInput::Push::kAccepted);
  EXPECT_EQ(*input.at(tiltedAt(1000, 0.2, -0.15)), 2.0);
  EXPECT_FALSE(input.at(tiltedAt(1000, 0.4))) << "its sonar hears no echo from there";
  EXPECT_EQ(input.tilted(), 1U);
}

TEST(HeightInput, OfABurstOfVerticalReadingsTheLastCounts) {
  HeightInputConfig config;
  config.use_navdata_height = true;
  HeightInput input(config, 10);
  for (const double height_m : {2.0, 2.1, 2.2}) {
    RangeReading height = reading(1000, height_m);
    height.is_vertical = true;
    EXPECT_EQ(input.push(height), HeightInput::Push::kAccepted);
  }
  EXPECT_EQ(*input.at(tiltedAt(1000)), 2.2);
  EXPECT_EQ(input.push({900 * kMillisecond_ns, 2.0, 0.2, 4, true}),
            HeightInput::Push::kNotAscending);
  EXPECT_EQ(input.push({1000 * kMillisecond_ns, 9.0, 0.2, 4, true}),
            HeightInput::Push::kOutOfRange);
  EXPECT_EQ(*input.at(tiltedAt(1000)), 2.2);
  EXPECT_EQ(input.refused(), 2U);
}

TEST(HeightInput, WhatIsNoRangeIsRefusedAndCounted) {
  HeightInput input(withRange(), 10);
  using Push = HeightInput::Push;
  EXPECT_EQ(input.push(reading(1000, std::nan(""))), Push::kOutOfRange);
  EXPECT_EQ(input.push(reading(1000, std::numeric_limits<double>::infinity())), Push::kOutOfRange);
  EXPECT_EQ(input.push(reading(1000, 0.1)), Push::kOutOfRange);
  EXPECT_EQ(input.push(reading(1000, 4.1)), Push::kOutOfRange);
  EXPECT_EQ(input.push({1, 0, 0, 4}), Push::kOutOfRange);
  EXPECT_FALSE(input.at(tiltedAt(1000)));
  EXPECT_EQ(input.push(reading(1000, 1)), Push::kAccepted);
  EXPECT_EQ(input.push(reading(1000, 1)), Push::kNotAscending);
  EXPECT_EQ(input.push(reading(999, 1)), Push::kNotAscending);
  EXPECT_EQ(input.refused(), 7U);
  input.clear();
  EXPECT_EQ(input.push(reading(10, 1)), Push::kAccepted) << "time began again";
}

TEST(HeightInput, ImagesWithoutARangeAreCounted) {
  HeightInput input(withRange(), 10);
  EXPECT_FALSE(input.at(tiltedAt(1000)));
  input.push(reading(1000, 1));
  EXPECT_TRUE(input.at(tiltedAt(1000)));
  EXPECT_FALSE(input.at(tiltedAt(1000, 0.4)));
  EXPECT_FALSE(input.at(tiltedAt(9000))) << "its range is long past";
  EXPECT_EQ(input.missing(), 2U);
  EXPECT_EQ(input.tilted(), 1U);
  HeightInput without(HeightInputConfig(), 10);
  EXPECT_FALSE(without.at(tiltedAt(1000)));
  EXPECT_EQ(without.missing(), 0U) << "nobody asked for one";
}

TEST(HeightInput, AKnownHeightIsConstantAndNeedsNoRange) {
  HeightInputConfig config;
  EXPECT_FALSE(HeightInput(config, 10).at(tiltedAt(1000)));
  config.known_height_m = 1.65;
  EXPECT_EQ(*HeightInput(config, 10).at(tiltedAt(1000, 0.1)), 1.65);
}

}  // namespace
}  // namespace ardrone_vslam
