// SPDX-License-Identifier: BSD-3-Clause
// Laps on a computer with too little time for an image: what is left out, and what becomes of the
// pose.
#include <gtest/gtest.h>

#include <array>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

/// Each work takes a millisecond, as does each look at whether there is time for it.
test::FlightRun flyWithin(double budget_ms) {
  const test::Flight flight = test::lapsFlight(400, 4, 10);
  const std::vector<OdometryState> odometry = test::observe(flight, {}, 1);
  test::PointWorld world = test::pointRoom(1);
  SlamConfig config = test::configForDrift();
  config.frame_budget.frame_budget_ms = budget_ms;
  Slam slam(config, test::forwardExtrinsics());
  test::FlightRun flown;
  const std::vector<ImageFeatures> frames = test::film(world, flight);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double now_ms = 0;
    flown.results.push_back(slam.process(frames[i], odometry[i], {}, [&] { return now_ms++; }));
  }
  flown.fused = test::errorOf(
      flight, [&](std::size_t i) { return flown.results[i].T_map_base.translation(); });
  flown.odometry =
      test::errorOf(flight, [&](std::size_t i) { return odometry[i].T_odom_base.translation(); });
  return flown;
}

std::array<int, 3> leftOut(const test::FlightRun& flown) {
  std::array<int, 3> images{};
  for (const FrameResult& result : flown.results) {
    for (std::size_t i = 0; i < images.size(); ++i) images[i] += result.left_out[i];
  }
  return images;
}

TEST(FrameBudgetFlight, EnoughTimeChangesNothing) {
  const test::FlightRun without = flyWithin(0);
  const test::FlightRun enough = flyWithin(100);
  EXPECT_EQ(leftOut(enough), (std::array<int, 3>{}));
  for (std::size_t i = 0; i < without.results.size(); ++i) {
    EXPECT_TRUE(without.results[i].T_map_base.matrix() == enough.results[i].T_map_base.matrix());
  }
}

TEST(FrameBudgetFlight, ALittleLessTimeCostsLandmarksAndNotThePose) {
  const test::FlightRun flown = flyWithin(3);
  const auto images = leftOut(flown);
  EXPECT_GT(images[1], 10);                                    // measured: 34 of 1600
  EXPECT_LT(images[2], 30);                                    // measured: 7
  EXPECT_LT(flown.fused.rmse_m, 0.1 * flown.odometry.rmse_m);  // measured: 0.053; 0.066 with time
}

TEST(FrameBudgetFlight, WithNoTimeAtAllThePoseIsTheOdometrys) {
  const test::FlightRun flown = flyWithin(1);
  EXPECT_GT(leftOut(flown)[2], 1500);                           // measured: 1560 of 1600
  EXPECT_LT(flown.fused.rmse_m, 1.05 * flown.odometry.rmse_m);  // measured: 0.81
  for (const FrameResult& result : flown.results) ASSERT_TRUE(isFinite(result));
}

}  // namespace
}  // namespace ardrone_vslam
