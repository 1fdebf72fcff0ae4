// SPDX-License-Identifier: BSD-3-Clause
#include "input_checks/speed_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "run/offline_run.hpp"
#include "support/odometry_states.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kStart_ns = 1'000'000'000'000;

OdometryState stateAt(double stamp_s, const Eigen::Vector3d& position_m) {
  return test::odometryAt(kStart_ns + static_cast<std::int64_t>(stamp_s * 1e9), position_m);
}

/// Of a drone that flies back and forth at up to 2 m/s for 20 s.
double absurdSpeed(double rate_hz, double unit) {
  SpeedWatch watch;
  for (double t = 0; t < 20; t += 1 / rate_hz)
    watch.see(stateAt(t, unit * Eigen::Vector3d(2 * std::sin(t), 1, 0.1 * t)));
  return watch.absurd_m_s();
}

TEST(SpeedWatch, TellsMillimetresFromMetres) {
  for (const double rate_hz : {5.0, 30.0, 200.0}) {
    EXPECT_EQ(absurdSpeed(rate_hz, 1), 0) << rate_hz;
    EXPECT_GT(absurdSpeed(rate_hz, 1000), SpeedWatch::kAbsurd_m_s) << rate_hz;
  }
}

TEST(SpeedWatch, AFastCarIsNoFault) {
  SpeedWatch watch;
  for (int i = 0; i < 1000; ++i) watch.see(stateAt(0.01 * i, {0.95 * i, 0, 0}));  // 342 km/h
  EXPECT_EQ(watch.absurd_m_s(), 0);
}

TEST(SpeedWatch, JumpsNoiseAndStampsThatGoBackAreNoSpeed) {
  SpeedWatch watch;
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0, 0.5);
  for (int i = 0; i < 2000; ++i) {
    const double jump_m = i / 100 % 2 == 0 ? 0 : 500;
    watch.see(stateAt(0.005 * i, {jump_m + noise_m(random), noise_m(random), 0}));
  }
  EXPECT_EQ(watch.absurd_m_s(), 0);
  for (int i = 0; i < 2000; ++i)  // six at a time
    watch.see(stateAt(100 + 0.03 * std::floor(i / 6.0) + 1e-6 * (i % 6), {0.01 * i, 0, 0}));
  EXPECT_EQ(watch.absurd_m_s(), 0);
  // A bag from the start, again and again, elsewhere each time.
  for (int i = 0; i < 100; ++i) watch.see(stateAt(i % 2 == 0 ? 0 : 20, {1e5 * i, 0, 0}));
  EXPECT_EQ(watch.absurd_m_s(), 0);
}

TEST(SpeedWatch, ReplayWatchesItsOdometry) {
  std::vector<OdometryState> states;
  states.reserve(30);
  for (int i = 0; i < 30; ++i) states.push_back(stateAt(0.1 * i, {30.0 * i, 0, 0}));
  BackEnd back_end(SlamConfig{}, Eigen::Isometry3d::Identity(), states);
  TrackedFrame frame;
  frame.features.stamp_ns = states.back().stamp_ns;
  back_end.process(frame);
  EXPECT_NEAR(back_end.result().absurd_speed_m_s, 300, 1e-3);
}

TEST(SpeedWatch, TheSentenceHasTopicSpeedAndRemedy) {
  EXPECT_EQ(explainSpeed("the odometry on /odom", 1234.5)
                .rfind("the odometry on /odom moves at 1230 m/s for a second", 0),
            0U);
  EXPECT_NE(explainSpeed("the odometry", 200).find("metres are expected"), std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam
