// SPDX-License-Identifier: BSD-3-Clause
// Prediction, fusion and its gate; thesis_filter_test.cpp has the position by landmarks.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/odometry_states.hpp"
#include "support/printed_filter.hpp"

namespace ardrone_vslam {
namespace {

using test::odometryAt;
using test::printedOnly;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

PositionFix fixAt(const Eigen::Vector3d& position, double sigma_m, double shared_m2 = 0) {
  PositionFix fix;
  fix.position_map = position;
  fix.covariance = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
  fix.shared_variance_m2 = shared_m2;
  return fix;
}

TEST(ThesisFilter, WorkedExampleOfThePrintedFusion) {
  ThesisFilterConfig config = printedOnly();
  config.initial_sigma_m = 0.3;
  ThesisFilter filter(config);
  filter.start({1, 2, 3}, odometryAt(0, {1, 2, 3}));
  ASSERT_TRUE(filter.fuse(fixAt({2, 2, 3}, 0.1)));
  const double gain = 0.09 / (0.09 + 0.01);  // (6.9, 6.10)
  EXPECT_TRUE(filter.position_map().isApprox(Eigen::Vector3d(1 + gain, 2, 3), 1e-12));  // (6.11)
  EXPECT_NEAR(filter.sigma_m(), std::sqrt((1 - gain) * 0.09), 1e-12);                   // (6.12)
}

TEST(ThesisFilter, PredictionFollowsTheOdometrysIncrement) {
  ThesisFilterConfig config = printedOnly();
  config.initial_sigma_m = 0.1;
  config.odometry_noise_m_per_sqrt_m = 0.02;
  config.odometry_noise_m_per_sqrt_s = 0.03;
  ThesisFilter filter(config);
  filter.start({10, 0, 0}, odometryAt(kSecond_ns, {0, 0, 0}));
  filter.predict(odometryAt(3 * kSecond_ns, {0, 4, 0}));
  EXPECT_TRUE(filter.position_map().isApprox(Eigen::Vector3d(10, 4, 0), 1e-12));
  const double variance = 0.01 + 0.02 * 0.02 * 4 + 0.03 * 0.03 * 2;
  EXPECT_NEAR(filter.sigma_m(), std::sqrt(variance), 1e-12);
}

TEST(ThesisFilter, PredictionTakesTheOdometrysOwnGrowthIfThereIsAny) {
  ThesisFilterConfig config = printedOnly();
  config.initial_sigma_m = 0.1;
  config.odometry_noise_m_per_sqrt_s = 0.5;
  ThesisFilter filter(config);
  OdometryState first = odometryAt(0, {0, 0, 0});
  first.covariance.topLeftCorner<3, 3>() = 0.2 * Eigen::Matrix3d::Identity();
  filter.start({0, 0, 0}, first);
  OdometryState second = odometryAt(kSecond_ns, {0, 0, 0});
  second.covariance.topLeftCorner<3, 3>() = 0.23 * Eigen::Matrix3d::Identity();
  filter.predict(second);
  EXPECT_NEAR(filter.covariance()(0, 0), 0.01 + 0.03, 1e-12);

  // A constant covariance tells nothing, not even when its last bit changes.
  OdometryState third = second;
  third.stamp_ns = 2 * kSecond_ns;
  third.covariance *= 1 + 1e-15;
  filter.predict(third);
  EXPECT_NEAR(filter.covariance()(0, 0), 0.04 + 0.25, 1e-12);
}

TEST(ThesisFilter, AVarianceThatIsNotGivenIsNoGrowth) {
  ThesisFilterConfig config = printedOnly();
  config.initial_sigma_m = 0.1;
  config.odometry_noise_m_per_sqrt_s = 0.5;
  const double kLargest = std::numeric_limits<double>::max();
  for (const double marker : {0.0, -1.0, -kLargest, 99999.0, 1e6, 1e12, kLargest}) {
    ThesisFilter filter(config);
    OdometryState state = odometryAt(0, {0, 0, 0});
    state.covariance = 0.2 * Matrix6d::Identity();
    filter.start({0, 0, 0}, state);
    double expected = 0.01;
    for (const double variance : {marker, 0.3, marker, 2 * marker}) {
      state.stamp_ns += kSecond_ns;
      state.covariance = variance * Matrix6d::Identity();
      filter.predict(state);
      expected += 0.25;
      EXPECT_NEAR(filter.covariance()(0, 0), expected, 1e-12) << marker;
    }
  }
}

TEST(ThesisFilter, AFixThatIsNotFiniteIsRejected) {
  ThesisFilter filter(printedOnly());
  filter.start(Eigen::Vector3d::Zero(), odometryAt(0, {0, 0, 0}));
  PositionFix fix = fixAt({0, 0, 0}, 0.1);
  fix.covariance(1, 1) = std::nan("");
  EXPECT_FALSE(filter.fuse(fix));
  EXPECT_TRUE(filter.position_map().allFinite());
  EXPECT_TRUE(filter.covariance().allFinite());
}

TEST(ThesisFilter, GateRejectsAndLeavesThePrediction) {
  ThesisFilterConfig config = printedOnly();
  config.initial_sigma_m = 0.03;
  config.gate_sigmas = 3;
  ThesisFilter filter(config);
  filter.start(Eigen::Vector3d::Zero(), odometryAt(0, {0, 0, 0}));
  // Sigma of the innovation: hypot(0.03, 0.04) = 0.05.
  EXPECT_FALSE(filter.fuse(fixAt({0.151, 0, 0}, 0.04)));
  EXPECT_EQ(filter.position_map(), Eigen::Vector3d(Eigen::Vector3d::Zero()));
  EXPECT_NEAR(filter.sigma_m(), 0.03, 1e-15);
  EXPECT_TRUE(filter.fuse(fixAt({0.149, 0, 0}, 0.04)));
}

// Landmarks made a moment ago carry the pose's present error (docs/thesis_estimator.md, common
// drift).
TEST(CommonDrift, FreshLandmarksCorrectNothing) {
  ThesisFilterConfig config = printedOnly();
  config.common_drift = true;
  config.initial_sigma_m = 0.2;
  ThesisFilter filter(config);
  filter.start(Eigen::Vector3d::Zero(), odometryAt(0, {0, 0, 0}));
  ASSERT_TRUE(filter.fuse(fixAt({0.1, 0, 0}, 0.05, 0.2 * 0.2)));
  EXPECT_LT(filter.position_map().norm(), 1e-12);
  EXPECT_NEAR(filter.sigma_m(), 0.2, 1e-12);
}

TEST(CommonDrift, OldLandmarksCorrectTheDriftSinceAndNoMore) {
  ThesisFilterConfig config = printedOnly();
  config.common_drift = true;
  config.initial_sigma_m = 0.1;
  config.odometry_noise_m_per_sqrt_s = 1;
  ThesisFilter filter(config);
  filter.start(Eigen::Vector3d::Zero(), odometryAt(0, {0, 0, 0}));
  const double then_m2 = filter.covariance()(0, 0);
  filter.predict(odometryAt(4 * kSecond_ns, {0, 0, 0}));  // drift: 4 m^2
  ASSERT_TRUE(filter.fuse(fixAt({1, 0, 0}, 0.001, then_m2)));
  EXPECT_NEAR(filter.position_map().x(), 1, 1e-6) << "the drift is all of the error";
  EXPECT_NEAR(filter.covariance()(0, 0), then_m2, 2e-6) << "P_a stays";
  EXPECT_GE(filter.covariance()(0, 0), then_m2);
}

TEST(CommonDrift, GainIsThatOfTheDriftAlone) {
  ThesisFilterConfig config = printedOnly();
  config.common_drift = true;
  config.initial_sigma_m = 0.5;
  ThesisFilter filter(config);
  filter.start(Eigen::Vector3d::Zero(), odometryAt(0, {0, 0, 0}));
  ASSERT_TRUE(filter.fuse(fixAt({1, 0, 0}, 0.3, 0.16)));  // P_t = 0.25, P_a = 0.16, R = 0.09
  EXPECT_NEAR(filter.position_map().x(), 0.09 / (0.09 + 0.09), 1e-12);
  EXPECT_NEAR(filter.covariance()(0, 0), 0.16 + 0.5 * 0.09, 1e-12);
}

}  // namespace
}  // namespace ardrone_vslam
