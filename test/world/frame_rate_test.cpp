// SPDX-License-Identifier: BSD-3-Clause
// `estimator: msckf` on one flight filmed at the rates that drones film at.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "msckf/msckf.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;
using test::PointWorld;

constexpr double kMostHz = 60;
constexpr double kLap_s = 20;
constexpr int kRounds = 3;

/// Frames 0, every, 2 every .. of what was drawn at the highest rate: the same drift at all rates.
template <class Item>
std::vector<Item> thinned(const std::vector<Item>& all, int every) {
  std::vector<Item> some;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(every))
    some.push_back(all[i]);
  return some;
}

/// Corners get lost as often in a second at every rate.
PointWorld room(std::uint64_t seed, int hz) {
  ViewFaults faults;
  faults.lost_share = 0.3 / hz;
  return test::pointRoom(seed, faults);
}

/// Keyframes of the whole flight.
int keyframesOf(const std::vector<ImageFeatures>& frames,
                const std::vector<OdometryState>& odometry) {
  Msckf filter(test::configForDrift().msckf, test::forwardExtrinsics());
  FrameBudget time;
  int count = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    i == 0 ? filter.start(odometry[i]) : filter.predict(odometry[i]);
    filter.track(frames[i], time);
    if (filter.isKeyframe()) ++count;
  }
  return count;
}

TEST(FrameRate, TracksWorkAtEveryRateAndKeyframesFollowTheWay) {
  const Flight flight = test::lapsFlight(static_cast<int>(kLap_s * kMostHz), kRounds, kMostHz);
  const double displacement_m = 2 * M_PI * 2.5 * kRounds;
  std::map<int, double> keyframes_per_m;
  for (const int hz : {3, 10, 30, 60}) {
    const int every = static_cast<int>(kMostHz) / hz;
    const Flight filmed = thinned(flight, every);
    std::vector<double> ratios;
    for (const std::uint64_t seed : {1, 2, 3}) {
      const std::vector<OdometryState> odometry = thinned(test::observe(flight, {}, seed), every);
      PointWorld world = room(seed, hz);
      const FlightRun run = test::fly(world, filmed, odometry, test::configForDrift());
      ratios.push_back(run.fused.rmse_m / run.odometry.rmse_m);
      if (seed > 1) continue;
      PointWorld same = room(seed, hz);
      keyframes_per_m[hz] = keyframesOf(test::film(same, filmed), odometry) / displacement_m;
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LT(ratios[1], 0.24) << hz << " Hz";  // measured: 0.12 to 0.16
    EXPECT_LT(ratios[2], 0.32) << hz << " Hz";  // measured: 0.18 to 0.21
  }
  // Measured: 1.7, 2.0, 2.2, 2.2 a metre.
  for (const int hz : {3, 30, 60}) {
    EXPECT_LT(keyframes_per_m[hz], 2 * keyframes_per_m[10]) << hz << " Hz";
    EXPECT_GT(keyframes_per_m[hz], keyframes_per_m[10] / 2) << hz << " Hz";
  }
}

}  // namespace
}  // namespace ardrone_vslam
