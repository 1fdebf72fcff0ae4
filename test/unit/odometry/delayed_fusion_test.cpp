// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/delayed_fusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/odometry_states.hpp"

namespace ardrone_vslam {
namespace {

using Answer = DelayedFusion::Answer;
using Push = OdometryBuffer::Push;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 1'000'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// At `ms` after the start, 1 m/s along x of odom.
OdometryState forwardAt(int ms) {
  OdometryState state = test::odometryAt(kStart_ns + ms * kMillisecond_ns, {1e-3 * ms, 0, 0});
  state.twist_base << 1, 0, 0, 0, 0, 0.5;
  return state;
}

/// Of the image at `ms`: base was `offset_m` to the left of where the odometry was, turned by yaw.
LateCorrection correctionAt(int ms, double offset_m, double yaw_rad = 0) {
  LateCorrection correction;
  correction.stamp_ns = kStart_ns + ms * kMillisecond_ns;
  correction.T_odom_base = forwardAt(ms).T_odom_base;
  correction.T_map_base = correction.T_odom_base;
  correction.T_map_base.translation().y() += offset_m;
  correction.T_map_base.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  correction.covariance = 1e-4 * Matrix6d::Identity();
  return correction;
}

/// No noise of its own: what remains of the covariance is the correction's.
DelayedFusionConfig noiseless() {
  DelayedFusionConfig config;
  config.walk_m_per_sqrt_m = 0;
  config.walk_m_per_sqrt_s = 0;
  config.velocity_bias_m_s = 0;
  config.scale_sigma = 1e-6;  // the least
  config.tilt_sigma_deg = 0;
  config.yaw_walk_deg_per_sqrt_s = 0;
  config.yaw_walk_deg_per_sqrt_m = 0;
  return config;
}

void fly(DelayedFusion& fusion, int from_ms, int to_ms, int step_ms = 5) {
  for (int ms = from_ms; ms <= to_ms; ms += step_ms) {
    ASSERT_EQ(fusion.push(forwardAt(ms)), Push::kAccepted);
  }
}

TEST(DelayedFusion, SaysNothingBeforeTheFirstCorrection) {
  DelayedFusion fusion({});
  EXPECT_FALSE(fusion.newest());
  EXPECT_EQ(fusion.correct(correctionAt(0, 1)), Answer::kNotYet) << "no odometry at all";
  fly(fusion, 0, 100);
  EXPECT_FALSE(fusion.newest());
  EXPECT_TRUE(fusion.sinceCorrection().empty());
}

TEST(DelayedFusion, ALateCorrectionMovesAllOdometrySinceItsStamp) {
  DelayedFusion fusion({});
  fly(fusion, 0, 200);
  ASSERT_EQ(fusion.correct(correctionAt(102, 0.5, M_PI / 2)), Answer::kUsed);
  const auto states = fusion.sinceCorrection();
  ASSERT_EQ(states.size(), 20U);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double since_m = 0.003 + 0.005 * static_cast<double>(i);  // turned to the left
    EXPECT_EQ(states[i].stamp_ns, forwardAt(105 + 5 * static_cast<int>(i)).stamp_ns);
    EXPECT_TRUE(states[i].T_map_base.translation().isApprox(
        Eigen::Vector3d(0.102, 0.5 + since_m, 0), 1e-12));
  }
  const auto newest = fusion.newest();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->stamp_ns, states.back().stamp_ns);
  EXPECT_TRUE(newest->T_map_base.isApprox(states.back().T_map_base, 0));
  EXPECT_EQ(newest->covariance, states.back().covariance);
}

TEST(DelayedFusion, OdometryAfterTheCorrectionIsSeenThroughIt) {
  DelayedFusion fusion({});
  fly(fusion, 0, 100);
  ASSERT_EQ(fusion.correct(correctionAt(60, 0.5)), Answer::kUsed);
  fly(fusion, 105, 110);
  EXPECT_TRUE(
      fusion.newest()->T_map_base.translation().isApprox(Eigen::Vector3d(0.11, 0.5, 0), 1e-12));
  EXPECT_EQ(fusion.newest()->twist_base, forwardAt(110).twist_base);
  ASSERT_EQ(fusion.correct(correctionAt(93, -0.2)), Answer::kUsed);
  EXPECT_TRUE(
      fusion.newest()->T_map_base.translation().isApprox(Eigen::Vector3d(0.11, -0.2, 0), 1e-12));
  EXPECT_EQ(fusion.correctionStamp_ns(), kStart_ns + 93 * kMillisecond_ns);
}

TEST(DelayedFusion, RefusedCorrectionsChangeNothing) {
  DelayedFusionConfig config;
  config.odometry.buffer_s = 1;
  DelayedFusion fusion(config);
  fly(fusion, 0, 1500);
  fly(fusion, 2100, 2200);  // a hole
  ASSERT_EQ(fusion.correct(correctionAt(1300, 0.5)), Answer::kUsed);
  const Eigen::Isometry3d before = fusion.T_map_odom();

  EXPECT_EQ(fusion.correct(correctionAt(1300, 9)), Answer::kNotAfter);
  EXPECT_EQ(fusion.correct(correctionAt(1200, 9)), Answer::kNotAfter);
  EXPECT_EQ(fusion.correct(correctionAt(1800, 9)), Answer::kGap);
  EXPECT_EQ(fusion.correct(correctionAt(2201, 9)), Answer::kNotYet);
  LateCorrection other = correctionAt(2150, 9);
  other.T_odom_base.translation().z() += 1.01 * DelayedFusion::kLargestDifference_m;
  EXPECT_EQ(fusion.correct(other), Answer::kOtherOdometry);
  other = correctionAt(2150, 9);
  other.T_odom_base.rotate(
      Eigen::AngleAxisd(1.01 * DelayedFusion::kLargestDifference_rad, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(fusion.correct(other), Answer::kOtherOdometry);
  LateCorrection bad = correctionAt(2150, 9);
  bad.T_map_base.translation().x() = kNaN;
  EXPECT_EQ(fusion.correct(bad), Answer::kBad);
  EXPECT_TRUE(fusion.T_map_odom().isApprox(before, 0));

  DelayedFusion fresh(config);
  fly(fresh, 0, 1500);
  EXPECT_EQ(fresh.correct(correctionAt(400, 9)), Answer::kTooOld);
  EXPECT_FALSE(fresh.hasCorrection());
  EXPECT_EQ(fresh.correct(correctionAt(600, 1)), Answer::kUsed);
}

TEST(DelayedFusion, ACorrectionThatCameBeforeItsOdometryIsUsedWhenOfferedAgain) {
  DelayedFusion fusion({});
  fly(fusion, 0, 100);
  EXPECT_EQ(fusion.correct(correctionAt(102, 1)), Answer::kNotYet);
  fly(fusion, 105, 105);
  EXPECT_EQ(fusion.correct(correctionAt(102, 1)), Answer::kUsed);
  EXPECT_TRUE(
      fusion.newest()->T_map_base.translation().isApprox(Eigen::Vector3d(0.105, 1, 0), 1e-12));
}

TEST(DelayedFusion, ClearForgetsAll) {
  DelayedFusion fusion({});
  fly(fusion, 0, 200);
  ASSERT_EQ(fusion.correct(correctionAt(100, 0.5)), Answer::kUsed);
  EXPECT_EQ(fusion.push(forwardAt(10)), Push::kBackwardStamp);
  fusion.clear();
  EXPECT_FALSE(fusion.newest());
  fly(fusion, 10, 50);
  EXPECT_FALSE(fusion.newest());
  EXPECT_EQ(fusion.correct(correctionAt(40, 0.3)), Answer::kUsed) << "before the one forgotten";
  EXPECT_TRUE(
      fusion.newest()->T_map_base.translation().isApprox(Eigen::Vector3d(0.05, 0.3, 0), 1e-12));
}

TEST(DelayedFusion, CovarianceAtTheStampIsTheCorrections) {
  DelayedFusion fusion({});
  fly(fusion, 0, 100);
  LateCorrection correction = correctionAt(100, 0);
  correction.covariance.diagonal() << 1, 2, 3, 0.1, 0.2, 0.3;
  correction.covariance(0, 4) = correction.covariance(4, 0) = 0.4;
  ASSERT_EQ(fusion.correct(correction), Answer::kUsed);
  EXPECT_TRUE(fusion.newest()->covariance.isApprox(correction.covariance, 1e-12));
}

TEST(DelayedFusion, AttitudeErrorTurnsTheWaySince) {
  DelayedFusion fusion(noiseless());
  fly(fusion, 0, 2000, 500);  // 2 m along x
  LateCorrection correction = correctionAt(0, 0);
  correction.covariance.setZero();
  correction.covariance(5, 5) = 0.01;  // yaw, 0.1 rad
  ASSERT_EQ(fusion.correct(correction), Answer::kUsed);
  const Matrix6d P = fusion.newest()->covariance;
  EXPECT_NEAR(P(1, 1), 0.04, 1e-12) << "2 m times 0.1 rad across";
  EXPECT_NEAR(P(0, 0), 4e-12, 1e-14) << "2 m times the scale, along";
  EXPECT_NEAR(P(1, 5), 0.02, 1e-12);
  EXPECT_NEAR(P(5, 5), 0.01, 1e-12);
}

TEST(DelayedFusion, ConfiguredNoiseGrowsWithWayAndTime) {
  DelayedFusionConfig config = noiseless();
  config.walk_m_per_sqrt_m = 0.1;
  config.walk_m_per_sqrt_s = 0.2;
  config.velocity_bias_m_s = 0.3;
  config.scale_sigma = 0.5;
  config.yaw_walk_deg_per_sqrt_s = 18 / M_PI;
  config.yaw_walk_deg_per_sqrt_m = 36 / M_PI;
  DelayedFusion fusion(config);
  ASSERT_EQ(fusion.push(forwardAt(0)), Push::kAccepted);
  LateCorrection correction = correctionAt(0, 0);
  correction.covariance.setZero();
  ASSERT_EQ(fusion.correct(correction), Answer::kUsed);
  // There and back: the way counts for the walk, the displacement for the scale.
  OdometryState there = forwardAt(1000);
  there.T_odom_base.translation() << 3, 0, 0;
  OdometryState back = forwardAt(2000);
  back.T_odom_base.translation() << 2, 0, 0;
  fusion.push(there);
  fusion.push(back);
  const Vector6d variance = fusion.newest()->covariance.diagonal();
  const double isotropic = 0.01 * 4 + 0.04 * 2 + 0.36;
  EXPECT_NEAR(variance[0], isotropic + 0.25 * 4, 1e-12);
  EXPECT_NEAR(variance[1], isotropic, 1e-12);
  EXPECT_NEAR(variance[5], 0.01 * 2 + 0.04 * 4, 1e-12);
  EXPECT_EQ(variance[3], 0);
}

TEST(DelayedFusion, TheOdometrysOwnCovarianceReplacesTheWalkAndIsTurnedIntoMap) {
  DelayedFusionConfig config = noiseless();
  config.walk_m_per_sqrt_s = 1;
  DelayedFusion fusion(config);
  OdometryState first = forwardAt(0);
  first.covariance.diagonal() << 1, 2, 3, 9, 9, 9;
  OdometryState second = forwardAt(100);
  second.covariance.diagonal() << 1.5, 2, 2.9, 9, 9, 9;
  fusion.push(first);
  LateCorrection correction = correctionAt(0, 0, M_PI / 2);  // x of odom is y of map
  correction.covariance.setZero();
  ASSERT_EQ(fusion.correct(correction), Answer::kUsed);
  fusion.push(second);
  const Vector6d variance = fusion.newest()->covariance.diagonal();
  EXPECT_NEAR(variance[0], 0, 1e-12);
  EXPECT_NEAR(variance[1], 0.5, 1e-12);
  EXPECT_NEAR(variance[2], 0, 1e-12) << "an axis that shrinks takes nothing away";

  // A covariance that does not grow says nothing about the drift.
  OdometryState third = second;
  third.stamp_ns = forwardAt(1000).stamp_ns;
  third.covariance = first.covariance;
  fusion.push(third);
  EXPECT_NEAR(fusion.newest()->covariance(0, 0), 1, 1e-12) << "the walk of one second";
}

TEST(DelayedFusion, FaultsOfCorrections) {
  EXPECT_EQ(faultOf(correctionAt(0, 1, 1)), "");
  LateCorrection c = correctionAt(0, 1);
  c.covariance.setZero();
  EXPECT_EQ(faultOf(c), "") << "known exactly";
  c = correctionAt(0, 1);
  c.T_odom_base.linear()(0, 0) = kNaN;
  EXPECT_NE(faultOf(c), "");
  c = correctionAt(0, 1);
  c.covariance(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_NE(faultOf(c), "");
  c = correctionAt(0, 1);
  c.T_map_base.translation().y() = 1.1 * kFarthestOdometry_m;
  EXPECT_NE(faultOf(c), "");
  c = correctionAt(0, 1);
  c.covariance(0, 0) = -1e-12;
  EXPECT_NE(faultOf(c), "");
  c = correctionAt(0, 1);
  c.covariance(0, 1) = 2e-4;  // not symmetric
  EXPECT_NE(faultOf(c), "");
  c.covariance(1, 0) = 2e-4;  // a correlation of 2
  EXPECT_NE(faultOf(c), "");
  c = correctionAt(0, 1);
  c.covariance(0, 0) = 1e300;
  EXPECT_NE(faultOf(c), "");
}

TEST(DelayedFusion, ConfigurationIsChecked) {
  DelayedFusionConfig config;
  config.odometry.buffer_s = 0;
  config.scale_sigma = 2;
  try {
    DelayedFusion fusion(config);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("odometry_buffer_s"), std::string::npos);
  }
}

}  // namespace
}  // namespace ardrone_vslam
