// SPDX-License-Identifier: BSD-3-Clause
// What YawLevel learns of a yaw that walks, against the walk that was drawn.
#include "noise/yaw_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linear/scalars.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kImage_rad = 0.001;  // a pair's own error
constexpr double kSpan_s = 0.27;
constexpr double kBetween_s = 0.15;
constexpr int kYawSeeds = 40;

OdometryNoiseConfig configured() {
  OdometryNoiseConfig config;
  config.yaw_walk_deg_per_sqrt_s = 0.05;
  config.yaw_walk_deg_per_sqrt_m = 0.02;
  config.attitude_noise_deg = 0.05;
  return config;
}

SetupFinding pairAt(double time_s, double off_rad) {
  SetupFinding finding;
  finding.yaw.stamp_ns = std::llround(time_s * 1e9);
  finding.yaw.span_s = kSpan_s;
  finding.yaw.displacement_m = 8 * kSpan_s;
  finding.yaw.off_rad = off_rad;
  finding.yaw.variance_rad2 = squared(kImage_rad);
  return finding;
}

/// Overlapping pairs of a minute, of which one in twenty is wrong by a degree.
/// @param factor  of the walk that is drawn, over what is configured
double learned(double factor, std::uint64_t seed) {
  RandomSource random(seed, 5);
  const OdometryNoiseConfig config = configured();
  YawLevel level(config);
  const double sigma_rad = factor * std::sqrt(level.walk_rad2(kBetween_s, 8 * kBetween_s));
  const double white_rad =
      std::hypot(kImage_rad, std::sqrt(2.0) * radians(config.attitude_noise_deg));
  double before_rad = 0;
  for (double time_s = 1; time_s < 60; time_s += kBetween_s) {
    const double step_rad = sigma_rad * random.normal();
    const double part_rad = before_rad * std::sqrt(kSpan_s / kBetween_s - 1);
    double off_rad = step_rad + part_rad + white_rad * random.normal();
    if (random.chance(0.05)) off_rad += radians(1) * random.normal();
    level.learn(pairAt(time_s, off_rad));
    before_rad = step_rad;
  }
  return level.factor() / factor;
}

// Measured: deciles 0.76 to 1.
TEST(YawLevel, IsThatOfTheWalkWithinAMinute) {
  for (const double factor : {4.0, 10.0, 25.0}) {
    std::vector<double> ratios;
    for (std::uint64_t seed = 1; seed <= kYawSeeds; ++seed) ratios.push_back(learned(factor, seed));
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[kYawSeeds / 10], 1 / 1.5) << factor;
    EXPECT_LT(ratios[kYawSeeds * 9 / 10], 1.25) << factor;
  }
}

TEST(YawLevel, StaysAsConfiguredWhereTheOdometryIsNoWorse) {
  for (const double factor : {0.1, 1.0}) {
    for (std::uint64_t seed = 1; seed <= kYawSeeds; ++seed)
      EXPECT_EQ(std::lround(100 * factor * learned(factor, seed)), 100) << factor << ' ' << seed;
  }
}

TEST(YawLevel, StaysAsConfiguredWhereTheImagesTellNothing) {
  YawLevel level(configured());
  for (int i = 1; i < 400; ++i) {
    SetupFinding finding = pairAt(i * kBetween_s, 0.01);
    finding.yaw.variance_rad2 = 1;
    level.learn(finding);
  }
  EXPECT_EQ(level.factor(), 1);
}

TEST(YawLevel, OnePairCountsOnceAndNotWithAWrongSetUp) {
  YawLevel level(configured());
  for (int i = 0; i < 100; ++i) level.learn(pairAt(1, radians(1)));
  YawLevel once(configured());
  once.learn(pairAt(1, radians(1)));
  EXPECT_EQ(level.factor(), once.factor());
  for (int i = 0; i < 100; ++i) {
    SetupFinding wrong = pairAt(2 + i * kBetween_s, radians(5));
    wrong.fault = SetupFault::kExtrinsics;
    level.learn(wrong);
  }
  level.learn({});  // of another camera's first image
  level.learn(pairAt(30, 0));
  EXPECT_GE(level.factor(), 1) << "still a number";
}

TEST(YawLevel, BeginsAnewAsConfiguredAndForgetsWithinMinutes) {
  YawLevel level(configured());
  double time_s = 1;
  for (; time_s < 30; time_s += kBetween_s) level.learn(pairAt(time_s, radians(2)));
  EXPECT_GT(level.factor(), 5);
  for (; time_s < 400; time_s += kBetween_s) level.learn(pairAt(time_s, 0));
  EXPECT_EQ(level.factor(), 1);
  level.reset();
  EXPECT_EQ(level.factor(), 1);
}

TEST(YawLevel, AWalkOfZeroStaysZero) {
  OdometryNoiseConfig config = configured();
  config.yaw_walk_deg_per_sqrt_s = config.yaw_walk_deg_per_sqrt_m = 0;
  YawLevel level(config);
  for (int i = 1; i < 100; ++i) level.learn(pairAt(i * kBetween_s, radians(2)));
  EXPECT_EQ(level.walk_rad2(1, 1), 0);
  EXPECT_EQ(level.factor(), 1);
}

}  // namespace
}  // namespace ardrone_vslam
