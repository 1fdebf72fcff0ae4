// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/time_since_fix.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

constexpr double kWidening_s = 10;

std::vector<AnchorDrift> widened(TimeSinceFix& clock, const std::vector<std::uint32_t>& anchors) {
  std::vector<AnchorDrift> drifts;
  for (const std::uint32_t id : anchors) drifts.push_back({id, 1, 4});
  clock.widen(drifts, kWidening_s);
  return drifts;
}

TEST(TimeSinceFix, SigmasGrowWithBlindTimeSinceTheAnchor) {
  TimeSinceFix clock;
  EXPECT_EQ(widened(clock, {1})[0].position_m2, 1);
  clock.pass(20);
  const auto drifts = widened(clock, {1, 2});
  EXPECT_DOUBLE_EQ(drifts[0].position_m2, 9);
  EXPECT_DOUBLE_EQ(drifts[0].attitude_rad2, 36);
  EXPECT_EQ(drifts[1].position_m2, 1) << "begun since";
}

TEST(TimeSinceFix, AFixBringsWhatIsAsYoungBackInPlaceAndNothingOlder) {
  TimeSinceFix clock;
  widened(clock, {1});
  clock.pass(10);
  widened(clock, {1, 2, 3});
  clock.pass(10);
  clock.link({2});
  auto drifts = widened(clock, {1, 2, 3});
  EXPECT_DOUBLE_EQ(drifts[0].position_m2, 9);
  EXPECT_EQ(drifts[1].position_m2, 1);
  EXPECT_EQ(drifts[2].position_m2, 1);
  clock.link({});
  EXPECT_DOUBLE_EQ(widened(clock, {1, 2, 3})[0].position_m2, 9);
  clock.link({3, 1});
  for (const AnchorDrift& drift : widened(clock, {1, 2, 3})) EXPECT_EQ(drift.position_m2, 1);
}

}  // namespace
}  // namespace ardrone_vslam
