// SPDX-License-Identifier: BSD-3-Clause
// `estimator: msckf` in worlds of random points with random descriptors: errors against the
// truth.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "support/median.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

using test::Flight;
using test::FlightRun;
using test::PointWorld;

using test::kLapFrames;

double meanNees(const Flight& flight, const FlightRun& run) {
  double sum = 0;
  for (std::size_t i = 1; i < flight.size(); ++i) {
    const FrameResult& result = run.results[i];
    const Eigen::Vector3d error =
        result.T_map_base.translation() - flight[i].T_map_base.translation();
    sum += error.dot(result.covariance.topLeftCorner<3, 3>().inverse() * error);
  }
  return sum / static_cast<double>(flight.size() - 1);
}

TEST(MsckfWorld, RevisitsTakeTheDriftOutOfTheOdometry) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  struct Case {
    double wrong_share;
    double median;
    double worst;
  };
  // Measured: medians 0.14, 0.14 and 0.17, worst 0.23, 0.23 and 0.22, NEES 0.8 to 1.2.
  for (const Case& c : {Case{0, 0.16, 0.25}, Case{0.2, 0.17, 0.3}, Case{0.4, 0.22, 0.35}}) {
    std::vector<double> ratios;
    std::vector<double> nees;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      PointWorld world = test::pointRoom(seed, c.wrong_share);
      const FlightRun run =
          test::fly(world, flight, test::observe(flight, {}, seed), test::configForDrift());
      ratios.push_back(run.fused.rmse_m / run.odometry.rmse_m);
      nees.push_back(meanNees(flight, run));
      EXPECT_LT(ratios.back(), c.worst) << "seed " << seed << ", wrong " << c.wrong_share;
      EXPECT_GT(test::framesIn(run, SlamState::kLocalised), kLapFrames) << "seed " << seed;
      EXPECT_GT(test::framesIn(run, SlamState::kTracking), kLapFrames / 4) << "seed " << seed;
    }
    EXPECT_LT(test::median(ratios), c.median) << "wrong " << c.wrong_share;
    EXPECT_LT(test::median(nees), 2.1) << "wrong " << c.wrong_share;  // 1.4 over 20 seeds
  }
}

// Those that were not seen for longest are the ones that come next.
TEST(MsckfWorld, AMapSmallerThanTheLapStillTakesTheDriftOut) {
  const Flight flight = test::lapsFlight(kLapFrames, 4, 10);
  std::vector<double> ratios;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    PointWorld world = test::pointRoom(seed);
    SlamConfig config = test::configForDrift();
    config.landmark_map.max_landmarks = 200;  // of some 800
    const FlightRun run = test::fly(world, flight, test::observe(flight, {}, seed), config);
    ratios.push_back(run.fused.rmse_m / run.odometry.rmse_m);
    EXPECT_LE(run.results.back().landmarks, 200) << "seed " << seed;
  }
  // Measured: 0.07 to 0.31, median 0.14 of 20 seeds; 0.25 to 0.50 when the oldest go.
  EXPECT_LT(test::median(ratios), 0.2);
}

TEST(MsckfWorld, AFirstPassIsBetterThanTheOdometryAndKnowsHowGoodItIs) {
  const Flight flight = test::straightFlight(300, 10, 1);
  double sum = 0;
  std::vector<double> ratios;
  constexpr int kSeeds = 10;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PointWorld world(seed);
    world.addCorridor(50, 2000);
    const FlightRun run =
        test::fly(world, flight, test::observe(flight, {}, seed), test::configForDrift());
    ratios.push_back(run.fused.rmse_m / run.odometry.rmse_m);
    EXPECT_LT(ratios.back(), 1.05) << "seed " << seed;
    EXPECT_EQ(test::framesIn(run, SlamState::kFixRejected), 0) << "seed " << seed;
    sum += meanNees(flight, run);
  }
  EXPECT_LT(test::median(ratios), 0.6);  // measured: 0.53
  EXPECT_LT(sum / kSeeds, 0.5);          // 3 is honest; measured: 0.33
  EXPECT_GT(sum / kSeeds, 0.2);
}

TEST(MsckfWorld, TrueOdometryIsHardlyMadeWorse) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  for (const double wrong_share : {0.0, 0.2, 0.4}) {
    PointWorld world = test::pointRoom(1, wrong_share);
    const FlightRun run =
        test::fly(world, flight, test::observeExactly(flight), test::configForDrift());
    EXPECT_LT(run.fused.rmse_m, 0.04) << wrong_share;  // measured: at most 0.026 on 31 m
  }
}

TEST(MsckfWorld, TurningOnTheSpotMakesNoLandmarkAndMovesNothing) {
  Flight flight;
  for (int i = 0; i < 150; ++i) {
    test::FlightPose pose;
    pose.stamp_ns = test::stampOf(i, 10);
    pose.T_map_base.linear() =
        Eigen::AngleAxisd(0.03 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.T_map_base.translation() << 1, 1, 1.2;
    flight.push_back(pose);
  }
  PointWorld world = test::pointRoom(2);
  const FlightRun run =
      test::fly(world, flight, test::observeExactly(flight), test::configForDrift());
  EXPECT_EQ(run.landmarks.size(), 0U);
  EXPECT_LT(run.fused.max_m, 1e-6);
}

TEST(MsckfWorld, ADroneThatCirclesMakesNoLandmarksWhereItsMapIsKnown) {
  const Flight flight = test::lapsFlight(kLapFrames, 8, 10);
  for (const std::uint64_t seed : {1, 2}) {
    PointWorld world = test::pointRoom(seed, 0.3);
    const FlightRun run =
        test::fly(world, flight, test::observe(flight, {}, seed), test::configForDrift());
    EXPECT_LT(run.landmarks.size(), 930U);  // measured: 825, 818; else 1056, 1050 of 1200 points
  }
}

TEST(MsckfWorld, MovingAndTurningTheWorldMovesTheResultAlike) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  const std::vector<OdometryState> odometry = test::observe(flight, {}, 3);
  PointWorld world = test::pointRoom(3);
  const std::vector<ImageFeatures> frames = test::film(world, flight);
  Eigen::Isometry3d T_there_here = Eigen::Isometry3d::Identity();
  T_there_here.linear() = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_there_here.translation() << 30, -20, 5;
  std::vector<OdometryState> moved = odometry;
  for (OdometryState& state : moved) state.T_odom_base = T_there_here * state.T_odom_base;
  const FlightRun here = test::run(frames, odometry, test::configForDrift());
  const FlightRun there = test::run(frames, moved, test::configForDrift());
  std::vector<double> off_m;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Eigen::Vector3d expected =
        T_there_here * Eigen::Vector3d(here.results[i].T_map_base.translation());
    off_m.push_back((there.results[i].T_map_base.translation() - expected).norm());
    ASSERT_LT(off_m.back(), 0.05) << "frame " << i;
  }
  // Sooner or later something is decided otherwise by a hair: landmarks, for one, are looked for
  // in single precision, so that one at the edge of its window may be found in one world only.
  // Until then rounding is all.
  EXPECT_LT(test::median(off_m), 5e-7);  // measured: 2e-7; corrections are in single precision
}

TEST(MsckfWorld, AnErrorOfTheMountingIsFoundWhereItIsAllowedFor) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  PointWorld world = test::pointRoom(4);
  std::vector<ImageFeatures> frames = test::film(world, flight);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.02F, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  for (ImageFeatures& frame : frames) {
    for (Eigen::Vector3f& bearing : frame.bearing_cam) bearing = turn * bearing;
  }
  SlamConfig config = test::configForDrift();
  const auto rmseOf = [&](const FlightRun& run) {
    double sum = 0;
    for (std::size_t i = 0; i < flight.size(); ++i)
      sum += (run.results[i].T_map_base.translation() - flight[i].T_map_base.translation())
                 .squaredNorm();
    return std::sqrt(sum / static_cast<double>(flight.size()));
  };
  const std::vector<OdometryState> odometry = test::observe(flight, {}, 4);
  const double without_m = rmseOf(test::run(frames, odometry, config));
  config.msckf.odometry.extrinsics_sigma_deg = 1;
  const FlightRun with = test::run(frames, odometry, config);
  EXPECT_LT(rmseOf(with), 0.5 * without_m);
  EXPECT_LT(Eigen::AngleAxisd(with.results.back().T_map_base.linear().transpose() *
                              flight.back().T_map_base.linear())
                .angle(),
            0.01)
      << "the pose is the base's, not that of the camera's mounting";
}

TEST(MsckfWorld, OdometryThatIsWorseThanConfiguredIsToldByItsFixesAndAllowedFor) {
  const Flight flight = test::lapsFlight(kLapFrames, 3, 10);
  for (const std::uint64_t seed : {1, 2, 3}) {
    PointWorld world = test::pointRoom(seed);
    // From the second lap on its velocity is ten times as wrong as configured.
    std::vector<OdometryState> odometry = test::observe(flight, {}, seed);
    for (std::size_t i = kLapFrames; i < odometry.size(); ++i)
      odometry[i].T_odom_base.translation() +=
          Eigen::Vector3d(0.2, -0.2, 0.1) * 0.1 * static_cast<double>(i - kLapFrames);
    const FlightRun run = test::fly(world, flight, odometry, test::configForDrift());
    double highest = 0;
    for (const FrameResult& result : run.results) highest = std::max(highest, result.fix_nis);
    EXPECT_GT(highest, 1.5) << seed;  // measured: 1.9 to 2.6; of honest odometry 1, as it begins
    EXPECT_LT(run.fused.rmse_m / run.odometry.rmse_m, 0.08)
        << seed;  // measured: 0.04 to 0.05; with the configured error 0.56 to 0.61
    EXPECT_LT(meanNees(flight, run), 14) << seed;  // 5 to 9; else 185 to 200
  }
}

/// Root mean square error of z.
double heightError_m(const Flight& flight, const FlightRun& run) {
  double sum_m2 = 0;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    const double error_m =
        (run.results[i].T_map_base.translation() - flight[i].T_map_base.translation()).z();
    sum_m2 += error_m * error_m;
  }
  return std::sqrt(sum_m2 / static_cast<double>(flight.size()));
}

TEST(MsckfWorld, PlanarHoldsZOnLevelLaps) {
  const Flight flight = test::lapsFlight(kLapFrames, 2, 10);
  double free_m = 0;
  double planar_m = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    PointWorld world = test::pointRoom(seed, 0);
    const auto odometry = test::observe(flight, {}, seed);
    SlamConfig config = test::configForDrift();
    free_m += heightError_m(flight, test::fly(world, flight, odometry, config));
    config.planar = true;
    planar_m += heightError_m(flight, test::fly(world, flight, odometry, config));
  }
  EXPECT_LT(planar_m, 0.8 * free_m);  // measured: 0.68
}

}  // namespace
}  // namespace ardrone_vslam
