// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/frame_result.hpp"

namespace ardrone_vslam {
namespace {

class OdometryStepTest : public ::testing::Test {
 protected:
  std::optional<OdometryStep> see(double time_s, double x_m, double variance_m2 = 0) {
    OdometryState state;
    state.stamp_ns = 1'000'000'000 + std::llround(time_s * 1e9);
    state.T_odom_base.translation().x() = x_m;
    state.covariance.diagonal().head<3>().setConstant(variance_m2);
    return watch_.see(state);
  }

  OdometryStepWatch watch_;
};

TEST_F(OdometryStepTest, AStepIsItsExcessOverTheSpeedSoFar) {
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(see(0.1 * i, 0.2 * i)) << i;
  const auto step = see(1.0, 2.0 - 3);
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->jump_odom_m.x(), -3, 1e-9);
  EXPECT_NEAR(step->motion_odom_m.x(), 0.2, 1e-9);
  EXPECT_FALSE(see(1.1, 2.2 - 3)) << "over at once";
}

TEST_F(OdometryStepTest, DronesCarsAndGapsTakeNoSteps) {
  for (const double rate_hz : {3.0, 10.0, 30.0, 200.0}) {
    watch_ = {};
    // From rest to 8 m/s in a second, and back.
    for (int i = 0; i < 4 * rate_hz; ++i) {
      const double t = i / rate_hz;
      const double x = 4 * t - 4 * std::sin(M_PI * t) / M_PI;
      EXPECT_FALSE(see(t, x)) << rate_hz << " Hz, " << t;
    }
  }
  watch_ = {};
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(see(0.1 * i, 3.0 * i)) << "a car from the first image";
  EXPECT_FALSE(see(1.93, 3.0 * 20)) << "an image late by 0.07 s, after a gap";
  watch_ = {};
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(see(0.1 * i, 0.2 * i));
  EXPECT_FALSE(see(1.9, 3.8)) << "2 m/s through a gap of a second";
  EXPECT_FALSE(see(2.9, 4.0)) << "and a stop in the next";
}

TEST_F(OdometryStepTest, ACarThatStopsOrARecordingThatTurnsRoundTakesNone) {
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(see(0.1 * i, 1.5 * i));
  EXPECT_FALSE(see(1.0, 14.2)) << "half way on, half way back";
  for (int i = 2; i < 10; ++i) EXPECT_FALSE(see(0.9 + 0.1 * i, 15.7 - 1.5 * i)) << i;
  EXPECT_FALSE(see(1.9, 2.2)) << "standing";
  EXPECT_FALSE(see(2.0, 0.7)) << "a message came twice";
}

TEST_F(OdometryStepTest, WhatTheOdometrySaysOfItselfIsBelieved) {
  for (int i = 0; i < 10; ++i) ASSERT_FALSE(see(0.1 * i, 0.1 * i, 0.01));
  EXPECT_FALSE(see(1.0, 3, 1));
  EXPECT_TRUE(see(1.1, 6, 1));
}

TEST_F(OdometryStepTest, WhatGoesOnIsSpeed) {
  see(0, 0);
  see(0.1, 0);
  int steps = 0;
  for (int i = 2; i < 40; ++i) steps += see(0.1 * i, 50.0 * i) ? 1 : 0;
  EXPECT_EQ(steps, 5);
}

TEST_F(OdometryStepTest, AfterAFreezeInFlightTheWayMayHaveGoneOn) {
  const auto flyAndFreeze = [this] {
    watch_ = {};
    for (int i = 0; i < 10; ++i) ASSERT_FALSE(see(0.1 * i, 0.1 * i));
    for (int i = 10; i < 40; ++i) ASSERT_FALSE(see(0.1 * i, 0.9));
  };
  flyAndFreeze();
  EXPECT_NEAR(watch_.frozenWay_m(), 3, 0.01) << "1 m/s for 3 s";
  const auto thawed = see(4.0, 1.0);
  EXPECT_EQ(watch_.frozenWay_m(), 0);
  ASSERT_TRUE(thawed);
  EXPECT_EQ(thawed->jump_odom_m.norm(), 0);
  EXPECT_NEAR(thawed->motion_odom_m.x(), 0.1, 1e-9);
  EXPECT_NEAR(thawed->motion_sigma_m, 3, 0.01) << "1 m/s for 3 s";
  EXPECT_FALSE(see(4.1, 1.1));
  flyAndFreeze();
  const auto caught_up = see(4.0, 4.0);
  ASSERT_TRUE(caught_up);
  EXPECT_NEAR(caught_up->jump_odom_m.x(), 3, 0.01);
  watch_ = {};
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(see(0.1 * i, 0)) << "on the ground";
  EXPECT_FALSE(see(1.0, 0.02)) << "and taking off";
}

TEST_F(OdometryStepTest, TheSentenceHasSizeAndRemedy) {
  const std::string text = explainStep("the odometry on /odom", 2.04);
  for (const char* part : {"/odom", "2 m", "must not jump", "resets"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace ardrone_vslam
