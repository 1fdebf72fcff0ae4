// SPDX-License-Identifier: BSD-3-Clause
// Odometry that jumps, freezes or is missing for a while, in a room that is mapped already.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;
using test::PointWorld;

using test::kLapFrames;
constexpr std::size_t kFault = 300;  // frame, in the second of three laps

void stepBy(const Eigen::Vector3d& step_m, std::size_t from, std::vector<OdometryState>& odometry) {
  for (std::size_t i = from; i < odometry.size(); ++i)
    odometry[i].T_odom_base.translation() += step_m;
}

double errorAt(const Flight& flight, const FlightRun& run, std::size_t i) {
  return (run.results[i].T_map_base.translation() - flight[i].T_map_base.translation()).norm();
}

double worstFrom(std::size_t from, const Flight& flight, const FlightRun& run) {
  double worst_m = 0;
  for (std::size_t i = from; i < flight.size(); ++i)
    worst_m = std::max(worst_m, errorAt(flight, run, i));
  return worst_m;
}

double outsideShare(std::size_t from, const Flight& flight, const FlightRun& run) {
  constexpr double kNees3Sigma = 14.16;
  int outside = 0;
  for (std::size_t i = from; i < flight.size(); ++i) {
    const Eigen::Vector3d error =
        run.results[i].T_map_base.translation() - flight[i].T_map_base.translation();
    const Eigen::Matrix3d covariance = run.results[i].covariance.topLeftCorner<3, 3>();
    if (error.dot(covariance.inverse() * error) > kNees3Sigma) ++outside;
  }
  return outside / static_cast<double>(flight.size() - from);
}

int stepsIn(const FlightRun& run) {
  int steps = 0;
  for (const FrameResult& result : run.results) steps += result.odometry_step_m > 0 ? 1 : 0;
  return steps;
}

TEST(OdometryStepWorld, AStepIsToldAndIsNoWay) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    const auto frames = test::film(world, flight);
    for (const double step_m : {1.0, 2.0, 20.0}) {
      auto odometry = test::observe(flight, {}, seed);
      stepBy({step_m, 0, 0}, kFault, odometry);
      const FlightRun run = test::run(frames, odometry, test::msckfConfig());
      EXPECT_EQ(stepsIn(run), 1) << seed << ", " << step_m;
      EXPECT_NEAR(run.results[kFault].odometry_step_m, step_m, 0.3);
      // Measured: at most 0.24; when it is taken for a way 1 to 7 m for a step of 2 m.
      EXPECT_LT(worstFrom(kFault, flight, run), 0.35) << seed << ", " << step_m;
      EXPECT_LT(outsideShare(kFault, flight, run), 0.05) << seed << ", " << step_m;
    }
  }
}

TEST(OdometryStepWorld, AStepBeforeAnythingWasSeenAgainDoesNoHarmEither) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    stepBy({0, -3, 1}, 100, odometry);
    const FlightRun run = test::fly(world, flight, odometry, test::msckfConfig());
    EXPECT_EQ(stepsIn(run), 1) << seed;
    EXPECT_LT(run.fused.max_m, 0.5) << seed;  // of 20 seeds: at most 0.39
  }
}

TEST(OdometryStepWorld, AStepThatInterpolationSpreadsOverImagesIsOne) {
  const Flight flight = test::lapsFlight(3 * kLapFrames, 2, 30);
  for (const std::uint64_t seed : {1, 2}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    // Odometry at 10 Hz, images at 30 Hz.
    for (std::size_t i = 900; i < 903; ++i) stepBy({2.0 / 3, 0, 0}, i, odometry);
    const FlightRun run = test::fly(world, flight, odometry, test::msckfConfig());
    EXPECT_EQ(stepsIn(run), 3) << seed;
    EXPECT_LT(worstFrom(900, flight, run), 0.25) << seed;  // of 20 seeds: at most 0.164
  }
}

TEST(OdometryStepWorld, OdometryThatCatchesUpAfterAFreezeIsBelieved) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    for (std::size_t i = kFault; i < kFault + 30; ++i)
      odometry[i].T_odom_base = odometry[kFault - 1].T_odom_base;
    const FlightRun run = test::fly(world, flight, odometry, test::msckfConfig());
    EXPECT_LT(worstFrom(kFault + 32, flight, run), 0.4) << seed;
  }
}

TEST(OdometryStepWorld, AfterAFreezeThePlaceIsFoundAgain) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  for (const int frozen : {30, 50}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      PointWorld world = test::pointRoom(seed, 0.1);
      auto odometry = test::observe(flight, {}, seed);
      const std::size_t again = kFault + static_cast<std::size_t>(frozen);
      const Eigen::Isometry3d then = odometry[kFault].T_odom_base;
      const Eigen::Vector3d lost_m = odometry[again].T_odom_base.translation() - then.translation();
      for (std::size_t i = kFault; i < again; ++i) odometry[i].T_odom_base = then;
      stepBy(-lost_m, again, odometry);
      const FlightRun run = test::fly(world, flight, odometry, test::msckfConfig());
      EXPECT_LT(worstFrom(again + 1, flight, run), 0.37) << seed << ", " << frozen;  // 0.244
      for (std::size_t i = kFault + 7; i < again; ++i)
        ASSERT_LT(errorAt(flight, run, i), 3 * run.results[i].sigma_m) << "does not say so, " << i;
    }
  }
}

TEST(OdometryStepWorld, OdometryThatWasStartedAgainIsFoundInTheOwnMap) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  constexpr std::size_t kLost = 50;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    auto frames = test::film(world, flight);
    const Eigen::Isometry3d T_new_odom = odometry[kFault + kLost].T_odom_base.inverse();
    for (std::size_t i = kFault + kLost; i < odometry.size(); ++i) {
      odometry[i].T_odom_base = T_new_odom * odometry[i].T_odom_base;
      odometry[i].start = 1;
    }
    const auto cut = [](auto all) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(kFault),
                all.begin() + static_cast<std::ptrdiff_t>(kFault + kLost));
      return all;
    };
    const Flight seen = cut(flight);
    const FlightRun run = test::run(cut(frames), cut(odometry), test::msckfConfig());
    std::size_t found = kFault;
    while (found < seen.size() && run.results[found].state == SlamState::kSearchingMap) {
      EXPECT_GT(run.results[found].sigma_m, 999) << "nowhere yet";
      ++found;
    }
    EXPECT_GT(found, kFault) << seed;
    EXPECT_LT(found, kFault + 60) << seed;
    EXPECT_LT(worstFrom(found, seen, run), 0.4) << seed;
    EXPECT_LT(outsideShare(found, seen, run), 0.05) << seed;
  }
}

TEST(OdometryStepWorld, OdometryOfAnotherFlightIsDoubtedAndThenDistrusted) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  constexpr std::size_t kEnd = kFault + 70;
  int silent = 0;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    // It flies straight on and turns about itself.
    const Eigen::Isometry3d first = odometry[kFault].T_odom_base;
    for (std::size_t i = kFault; i < kEnd; ++i) {
      const auto passed = static_cast<double>(i - kFault);
      odometry[i].T_odom_base = first * Eigen::Translation3d(0.05 * passed, 0, 0) *
                                Eigen::AngleAxisd(-0.1 * passed, Eigen::Vector3d::UnitZ());
    }
    const FlightRun run = test::fly(world, flight, odometry, test::msckfConfig());
    bool is_distrusted = false;
    for (std::size_t i = kFault; i < kEnd; ++i) {
      const FrameResult& result = run.results[i];
      is_distrusted = is_distrusted || result.state == SlamState::kDistrusted;
      if (!is_distrusted && errorAt(flight, run, i) > 3 * result.sigma_m) ++silent;
    }
    found += is_distrusted ? 1 : 0;
  }
  // Measured: 34 images and 3 flights; 449 and none where tracks are not asked.
  EXPECT_LE(silent, 60);
  EXPECT_GE(found, 2);
}

TEST(OdometryStepWorld, TheFirstSearchAfterLostImagesAllowsForTheTimeWithoutThem) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  constexpr std::size_t kLost = 100;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    PointWorld world = test::pointRoom(seed, 0.1);
    auto odometry = test::observe(flight, {}, seed);
    auto frames = test::film(world, flight);
    // An error that the odometry does not claim, as it does after such a time.
    for (std::size_t i = kFault; i < odometry.size(); ++i)
      odometry[i].T_odom_base.translation() +=
          Eigen::Vector3d(0.1, -0.1, 0) * 0.1 * static_cast<double>(std::min(i - kFault, kLost));
    const auto cut = [](auto& all) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(kFault),
                all.begin() + static_cast<std::ptrdiff_t>(kFault + kLost));
    };
    cut(frames);
    cut(odometry);
    const FlightRun run = test::run(frames, odometry, test::msckfConfig());
    EXPECT_EQ(run.results[kFault].state, SlamState::kRelocated) << seed;
    EXPECT_LT((run.results[kFault].T_map_base.translation() -
               flight[kFault + kLost].T_map_base.translation())
                  .norm(),
              0.25)
        << seed;  // measured: at most 0.14, of 1.4 m
  }
}

}  // namespace
}  // namespace ardrone_vslam
