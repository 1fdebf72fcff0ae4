// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/odometry_states.hpp"
#include "support/yaw.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;
using Lookup = OdometryBuffer::Lookup;
using test::odometryAt;
using test::yawOf;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(OdometryBuffer, InterpolatesPositionOrientationAndCovariance) {
  OdometryBuffer buffer({});
  OdometryState first = odometryAt(kSecond_ns, {2, 0, 0}, 3.0);
  OdometryState second =
      odometryAt(kSecond_ns + 400'000'000, {6, 0, 0}, 3.4);  // across the wrap at pi
  first.covariance.setIdentity();
  second.covariance = 5 * Matrix6d::Identity();
  first.twist_base << 1, 2, 3, 4, 5, 6;
  second.twist_base << 5, 2, 3, 4, 5, 2;
  second.twist_covariance = 8 * Matrix6d::Identity();
  ASSERT_EQ(buffer.push(first), Push::kAccepted);
  ASSERT_EQ(buffer.push(second), Push::kAccepted);
  OdometryState state;
  ASSERT_EQ(buffer.at(kSecond_ns + 100'000'000, state), Lookup::kFound);
  EXPECT_EQ(state.stamp_ns, kSecond_ns + 100'000'000);
  EXPECT_NEAR(state.T_odom_base.translation().x(), 3, 1e-12);
  EXPECT_NEAR(yawOf(state.T_odom_base), 3.1, 1e-12);
  EXPECT_NEAR(state.covariance(4, 4), 2, 1e-12);
  Vector6d twist;
  twist << 2, 2, 3, 4, 5, 5;
  EXPECT_TRUE(state.twist_base.isApprox(twist, 1e-12)) << state.twist_base.transpose();
  EXPECT_NEAR(state.twist_covariance(0, 0), 2, 1e-12);
}

TEST(OdometryBuffer, EqualNeighboursStayEqualToTheBit) {
  OdometryState first = odometryAt(0, {0.1, 0, 0});
  first.covariance.setConstant(0.1);
  OdometryState second = first;
  second.stamp_ns = 1000;
  for (std::int64_t stamp = 1; stamp < 1000; ++stamp) {
    const OdometryState between = interpolate(first, second, stamp);
    ASSERT_EQ(between.covariance, first.covariance) << stamp;
    ASSERT_EQ(between.T_odom_base.translation(), first.T_odom_base.translation()) << stamp;
  }
}

TEST(OdometryBuffer, StoredStatesAreGivenAsTheyAre) {
  OdometryBuffer buffer({});
  buffer.push(odometryAt(1, {0.1, 0, 0}, 0.3));
  buffer.push(odometryAt(2, {0.7, 0, 0}, 0.9));
  OdometryState state;
  for (const std::int64_t stamp : {1, 2}) {
    ASSERT_EQ(buffer.at(stamp, state), Lookup::kFound);
    EXPECT_EQ(state.T_odom_base.translation().x(), stamp == 1 ? 0.1 : 0.7);
  }
}

TEST(OdometryBuffer, RefusesWhatIsNotFiniteDuplicateOrBackward) {
  OdometryBuffer buffer({});
  OdometryState nan_position = odometryAt(1);
  nan_position.T_odom_base.translation().y() = std::nan("");
  OdometryState nan_rotation = odometryAt(1);
  nan_rotation.T_odom_base.linear()(2, 1) = std::nan("");
  OdometryState endless_covariance = odometryAt(1);
  endless_covariance.covariance(0, 0) = std::numeric_limits<double>::infinity();
  OdometryState nan_twist = odometryAt(1);
  nan_twist.twist_base[5] = std::nan("");
  for (const OdometryState& bad : {nan_position, nan_rotation, endless_covariance, nan_twist})
    EXPECT_EQ(buffer.push(bad), Push::kNotFinite);
  EXPECT_TRUE(buffer.empty());

  ASSERT_EQ(buffer.push(odometryAt(10, {1, 0, 0})), Push::kAccepted);
  EXPECT_EQ(buffer.push(odometryAt(10, {2, 0, 0})), Push::kDuplicateStamp);
  EXPECT_EQ(buffer.push(odometryAt(9, {3, 0, 0})), Push::kBackwardStamp);
  OdometryState state;
  ASSERT_EQ(buffer.at(10, state), Lookup::kFound);
  EXPECT_EQ(state.T_odom_base.translation().x(), 1) << "a refused state changes nothing";
  EXPECT_EQ(buffer.newestStamp_ns(), 10);
}

TEST(OdometryBuffer, RefusesWhatNoDroneCanBe) {
  OdometryBuffer buffer({});
  OdometryState far_off = odometryAt(1);
  OdometryState too_fast = odometryAt(1);
  for (const double factor : {1.001, -1e3, 1e293}) {
    far_off.T_odom_base.translation().z() = factor * kFarthestOdometry_m;
    EXPECT_EQ(buffer.push(far_off), Push::kOutOfRange) << factor;
    too_fast.twist_base[4] = factor * kFastestOdometry;
    EXPECT_EQ(buffer.push(too_fast), Push::kOutOfRange) << factor;
  }
  EXPECT_NE(rangeFault(far_off).find("1e+300 m, beyond 1e+07 m"), std::string::npos);
  EXPECT_NE(rangeFault(too_fast).find("1e+296, beyond 1000 m/s or rad/s"), std::string::npos);
  EXPECT_TRUE(buffer.empty());

  OdometryState at_the_bound = odometryAt(1, {-kFarthestOdometry_m, 0, 0});
  at_the_bound.twist_base[0] = kFastestOdometry;
  EXPECT_EQ(rangeFault(at_the_bound), "");
  EXPECT_EQ(buffer.push(at_the_bound), Push::kAccepted);
}

TEST(OdometryBuffer, AVarianceThatMeansUnknownCountsAsNotGiven) {
  const double kLargest = std::numeric_limits<double>::max();
  OdometryState known = odometryAt(0);
  known.covariance = 0.5 * Matrix6d::Identity();
  EXPECT_EQ(positionVariance_m2(known).value_or(-1), 0.5);
  EXPECT_EQ(covarianceFault(known), "");
  known.covariance.bottomRightCorner<3, 3>() *= -1;  // of rotation, which is not used
  EXPECT_EQ(positionVariance_m2(known).value_or(-1), 0.5);
  OdometryState zero = odometryAt(0);
  EXPECT_FALSE(positionVariance_m2(zero));
  EXPECT_EQ(covarianceFault(zero), "") << "the usual way to give none";

  for (const double marker : {-1.0, 1.001 * kLargestVariance_m2, 99999.0, 1e12, kLargest}) {
    OdometryBuffer buffer({});
    OdometryState unknown = odometryAt(kSecond_ns / 10);
    unknown.covariance = known.covariance;
    unknown.covariance(2, 2) = marker;  // one axis is enough
    EXPECT_FALSE(positionVariance_m2(unknown)) << marker;
    EXPECT_NE(covarianceFault(unknown).find(marker < 0 ? "is negative" : "above 10000 m^2"),
              std::string::npos)
        << covarianceFault(unknown);
    ASSERT_EQ(buffer.push(known), Push::kAccepted);
    ASSERT_EQ(buffer.push(unknown), Push::kAccepted) << "the pose is as good as ever";
    OdometryState state;
    for (const std::int64_t stamp_ns : {std::int64_t{1}, kSecond_ns / 20, kSecond_ns / 10}) {
      ASSERT_EQ(buffer.at(stamp_ns, state), Lookup::kFound);
      EXPECT_FALSE(positionVariance_m2(state)) << "nothing lies between known and unknown";
      EXPECT_TRUE(state.covariance.isZero(0));
    }
  }
}

TEST(OdometryBuffer, TwistCovariancesOfAnySizeStayFinite) {
  OdometryBuffer buffer({});
  OdometryState first = odometryAt(0);
  first.twist_covariance.setConstant(std::numeric_limits<double>::max());
  OdometryState second = odometryAt(100);
  second.twist_covariance = -first.twist_covariance;
  ASSERT_EQ(buffer.push(first), Push::kAccepted);
  ASSERT_EQ(buffer.push(second), Push::kAccepted);
  OdometryState state;
  ASSERT_EQ(buffer.at(0, state), Lookup::kFound);
  EXPECT_EQ(state.twist_covariance(3, 1), kLargestTwistCovariance);
  ASSERT_EQ(buffer.at(50, state), Lookup::kFound);
  EXPECT_TRUE(state.twist_covariance.allFinite());
}

TEST(OdometryBuffer, EveryAnswerOfALookup) {
  OdometryBufferConfig config;
  config.max_gap_s = 0.5;
  OdometryBuffer buffer(config);
  OdometryState state = odometryAt(-1, {42, 0, 0});
  EXPECT_EQ(buffer.at(5, state), Lookup::kEmpty);
  buffer.push(odometryAt(kSecond_ns));
  EXPECT_EQ(buffer.at(kSecond_ns - 1, state), Lookup::kTooOld);
  EXPECT_EQ(buffer.at(kSecond_ns + 1, state), Lookup::kNotYet);
  buffer.push(odometryAt(kSecond_ns + 500'000'001));
  EXPECT_EQ(buffer.at(kSecond_ns + 1, state), Lookup::kGap);
  EXPECT_EQ(state.T_odom_base.translation().x(), 42) << "untouched unless found";
  EXPECT_EQ(buffer.at(kSecond_ns + 500'000'001, state), Lookup::kFound) << "the gap's end is there";
  buffer.push(odometryAt(kSecond_ns + 1'000'000'001));
  EXPECT_EQ(buffer.at(kSecond_ns + 600'000'000, state), Lookup::kFound) << "exactly max_gap_s";
}

TEST(OdometryBuffer, ForgetsWhatIsOlderThanItsLength) {
  OdometryBufferConfig config;
  config.buffer_s = 1;
  config.max_gap_s = 10;
  OdometryBuffer buffer(config);
  for (int i = 0; i <= 30; ++i) buffer.push(odometryAt(i * kSecond_ns / 10));
  OdometryState state;
  EXPECT_EQ(buffer.at(2 * kSecond_ns, state), Lookup::kFound);
  EXPECT_EQ(buffer.at(2 * kSecond_ns - 1, state), Lookup::kTooOld);
  buffer.push(odometryAt(100 * kSecond_ns));
  EXPECT_EQ(buffer.at(100 * kSecond_ns, state), Lookup::kFound) << "the newest always stays";
  buffer.clear();
  EXPECT_EQ(buffer.at(100 * kSecond_ns, state), Lookup::kEmpty);
}

}  // namespace
}  // namespace ardrone_vslam
