// SPDX-License-Identifier: BSD-3-Clause
// Odometry whose turns are wrong beside an IMU that knows them: the poses are the true ones.
#include "ardrone_vslam/imu_odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr double kStep_s = 0.02;
constexpr double kSpeed_m_s = 0.8;
constexpr int kSteps = 1500;

std::int64_t stampOf(double time_s) {
  return 1'000'000'000 + static_cast<std::int64_t>(std::llround(time_s * 1e9));
}

double trueYaw_rad(double time_s) {
  return 1.5 * std::sin(0.3 * time_s) + 0.2 * time_s;
}

/// A drive in curves, up a ramp of 8 degrees and down again.
Eigen::Matrix3d trueAttitude(double time_s) {
  const double pitch_rad = -8 * M_PI / 180 * std::sin(0.4 * time_s);
  return (Eigen::AngleAxisd(trueYaw_rad(time_s), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

/// The yaw is told 10 % too large, the ramp not at all.
Eigen::Matrix3d reportedAttitude(double time_s) {
  return Eigen::AngleAxisd(1.1 * trueYaw_rad(time_s), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

struct Drive {
  std::vector<OdometryState> truth;
  std::vector<OdometryState> odometry;
};

Drive drive() {
  Drive drive;
  Eigen::Vector3d position_m(1, 2, 0.3);
  Eigen::Vector3d reported_m = position_m;
  constexpr int kParts = 50;  // of a step
  for (int i = 0; i < kSteps; ++i) {
    OdometryState state;
    state.stamp_ns = stampOf(i * kStep_s);
    state.T_odom_base.linear() = trueAttitude(i * kStep_s);
    state.T_odom_base.translation() = position_m;
    drive.truth.push_back(state);
    state.T_odom_base.linear() = reportedAttitude(i * kStep_s);
    state.T_odom_base.translation() = reported_m;
    drive.odometry.push_back(state);
    for (int part = 0; part < kParts; ++part) {
      const double time_s = (i + (part + 0.5) / kParts) * kStep_s;
      const Eigen::Vector3d way_m = kSpeed_m_s * kStep_s / kParts * Eigen::Vector3d::UnitX();
      position_m += trueAttitude(time_s) * way_m;
      reported_m += reportedAttitude(time_s) * way_m;
    }
  }
  return drive;
}

/// 100 Hz, between the odometry's stamps; its world is turned, as an IMU's is.
ImuAttitude imuAt(int index) {
  const double time_s = 0.01 * index - 0.003;
  ImuAttitude attitude;
  attitude.stamp_ns = stampOf(time_s);
  attitude.R_world_base =
      Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(trueAttitude(time_s));
  return attitude;
}

constexpr int kAttitudes = 2 * kSteps + 10;

/// The IMU comes `ahead_s` before the odometry.
std::vector<OdometryState> run(const std::vector<OdometryState>& odometry, double ahead_s,
                               ImuOdometry& imu_odometry) {
  std::vector<OdometryState> ready;
  int next = 0;
  for (const OdometryState& state : odometry) {
    while (next < kAttitudes && imuAt(next).stamp_ns < state.stamp_ns + std::llround(ahead_s * 1e9))
      EXPECT_EQ(imu_odometry.push(imuAt(next++), ready), Push::kAccepted);
    EXPECT_EQ(imu_odometry.push(state, ready), Push::kAccepted);
  }
  while (next < kAttitudes) imu_odometry.push(imuAt(next++), ready);
  return ready;
}

double worst_m(const std::vector<OdometryState>& states, const std::vector<OdometryState>& truth) {
  double worst_m = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    worst_m = std::max(
        worst_m, (states[i].T_odom_base.translation() - truth[i].T_odom_base.translation()).norm());
  return worst_m;
}

TEST(ImuOdometry, TurnsAndRampsAreTheImusAndWaysTheOdometrys) {
  const Drive drive = ardrone_vslam::drive();
  EXPECT_GT(worst_m(drive.odometry, drive.truth), 2);
  ImuOdometry imu_odometry;
  const auto states = run(drive.odometry, 0, imu_odometry);
  ASSERT_EQ(states.size(), drive.odometry.size());
  EXPECT_EQ(imu_odometry.withoutAttitude(), 0U);
  EXPECT_LT(worst_m(states, drive.truth), 5e-5);  // measured: 2.4e-5
  for (std::size_t i = 0; i < states.size(); ++i) {
    ASSERT_EQ(states[i].stamp_ns, drive.odometry[i].stamp_ns);
    const Eigen::AngleAxisd off(states[i].T_odom_base.linear().transpose() *
                                drive.truth[i].T_odom_base.linear());
    ASSERT_LT(off.angle(), 1e-4) << i;  // interpolation: 0.25 rad/s over 10 ms
  }
}

TEST(ImuOdometry, TheOrderOfTheTwoInputsDoesNotMatter) {
  const Drive drive = ardrone_vslam::drive();
  ImuOdometry ahead;
  ImuOdometry behind;
  const auto one = run(drive.odometry, 0.4, ahead);
  const auto other = run(drive.odometry, -0.4, behind);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    ASSERT_EQ(one[i].T_odom_base.matrix(), other[i].T_odom_base.matrix()) << i;
}

TEST(ImuOdometry, WithoutAnAttitudeOdometryIsDroppedAndCounted) {
  const Drive drive = ardrone_vslam::drive();
  ImuOdometry imu_odometry;
  std::vector<OdometryState> ready;
  for (const OdometryState& state : drive.odometry) imu_odometry.push(state, ready);
  EXPECT_TRUE(ready.empty());
  EXPECT_EQ(imu_odometry.withoutAttitude(), kSteps - 26U);  // half a second still waits

  ImuOdometry with_hole;
  int next = 0;
  for (const OdometryState& state : drive.odometry) {
    for (; next < kAttitudes && imuAt(next).stamp_ns < state.stamp_ns; ++next)
      if (next < 1000 || next > 1200) with_hole.push(imuAt(next), ready);  // 2 s
    with_hole.push(state, ready);
  }
  EXPECT_NEAR(static_cast<double>(with_hole.withoutAttitude()), 100, 2);
  // What was driven in the hole is laid along its two ends: 1.6 m in a curve.
  EXPECT_LT(
      (ready.back().T_odom_base.translation() - drive.truth[kSteps - 2].T_odom_base.translation())
          .norm(),
      0.5);
}

TEST(ImuOdometry, OneWrongStampCostsLittleAndABagThatPlaysAgainBeginsAnew) {
  const Drive drive = ardrone_vslam::drive();
  ImuOdometry imu_odometry;
  std::vector<OdometryState> ready;
  ImuAttitude far = imuAt(0);
  far.stamp_ns += 1'000'000'000'000;
  imu_odometry.push(far, ready);
  OdometryState far_odometry = drive.odometry.front();
  far_odometry.stamp_ns += 1'000'000'000'000;
  imu_odometry.push(far_odometry, ready);
  for (int flight = 0; flight < 2; ++flight) {
    const auto states = run(drive.odometry, 0, imu_odometry);
    ASSERT_GT(states.size(), drive.odometry.size() - 30) << flight;
    const std::vector<OdometryState> truth(
        drive.truth.end() - static_cast<std::ptrdiff_t>(states.size()), drive.truth.end());
    EXPECT_LT(worst_m(states, truth), 2e-3) << flight;
  }
  ImuAttitude nonsense = imuAt(kAttitudes);
  nonsense.R_world_base.w() = std::nan("");
  EXPECT_EQ(imu_odometry.push(nonsense, ready), Push::kNotFinite);
  EXPECT_EQ(imu_odometry.push(imuAt(kAttitudes - 1), ready), Push::kDuplicateStamp);
  EXPECT_EQ(imu_odometry.push(imuAt(kAttitudes - 2), ready), Push::kBackwardStamp);
}

TEST(ImuOdometry, OnePositionBeyondAllReachIsRefusedAndSpoilsNothing) {
  const Drive drive = ardrone_vslam::drive();
  ImuOdometry imu_odometry;
  std::vector<OdometryState> ready;
  imu_odometry.push(imuAt(0), ready);
  imu_odometry.push(imuAt(1), ready);
  imu_odometry.push(drive.odometry[0], ready);
  OdometryState beyond = drive.odometry[0];
  beyond.T_odom_base.translation().setConstant(1e308);
  EXPECT_EQ(imu_odometry.push(beyond, ready), Push::kOutOfRange);
  for (int i = 2; i < 5; ++i) imu_odometry.push(imuAt(i), ready);
  imu_odometry.push(drive.odometry[1], ready);
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_LT(worst_m(ready, drive.truth), 0.01);
}

TEST(ImuOdometry, AfterAJumpBackByOneAndAHalfSecondsNothingOldIsUsed) {
  const Drive drive = ardrone_vslam::drive();
  const std::vector<OdometryState> first(drive.odometry.begin(), drive.odometry.begin() + 150);
  const std::vector<OdometryState> second(drive.odometry.begin() + 75,
                                          drive.odometry.begin() + 300);
  const auto feed = [](const std::vector<OdometryState>& odometry, double world_rad, bool imu_first,
                       ImuOdometry& imu_odometry) {
    std::vector<OdometryState> ready;
    const Eigen::AngleAxisd turn(world_rad, Eigen::Vector3d::UnitZ());
    int next = 0;
    while (imuAt(next + 1).stamp_ns <= odometry.front().stamp_ns) ++next;
    for (const OdometryState& state : odometry) {
      if (!imu_first) imu_odometry.push(state, ready);
      for (; imuAt(next).stamp_ns < state.stamp_ns + 20'000'000; ++next) {
        ImuAttitude attitude = imuAt(next);
        attitude.R_world_base = turn * attitude.R_world_base;
        imu_odometry.push(attitude, ready);
      }
      if (imu_first) imu_odometry.push(state, ready);
    }
    return ready;
  };
  for (const bool imu_first : {false, true}) {
    ImuOdometry fresh;
    const auto expected = feed(second, 1, imu_first, fresh);
    ImuOdometry used;
    feed(first, 0, imu_first, used);
    const auto states = feed(second, 1, imu_first, used);
    ASSERT_EQ(states.size(), expected.size()) << imu_first;
    for (std::size_t i = 0; i < states.size(); ++i)
      ASSERT_EQ(states[i].T_odom_base.matrix(), expected[i].T_odom_base.matrix()) << imu_first;
  }
}

}  // namespace
}  // namespace ardrone_vslam
