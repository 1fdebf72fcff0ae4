// SPDX-License-Identifier: BSD-3-Clause
#include "input/observer_input.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "onboard/flight_records.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;

class ObserverInputTest : public ::testing::Test {
 protected:
  bool accepts(const VslamObserver& observer, std::int64_t now_ns = 0) {
    const Record record = recordOf(observer);
    return input_.read(record.data(), record.size(), now_ns).has_value();
  }

  ObserverInput input_;
};

TEST_F(ObserverInputTest, GivesTheState) {
  VslamObserver observer = odometryAt(5, 1);
  observer.position_m[1] = 2;
  observer.quaternion[2] = observer.quaternion[3] = std::sqrt(0.5);
  observer.variance[0] = observer.variance[5] = 0.25;
  observer.height_m = 1.5;
  Record record = recordOf(observer);
  auto state = input_.read(record.data(), record.size(), 0);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp_ns, 5);
  EXPECT_EQ(state->T_odom_base.translation().y(), 2);
  EXPECT_NEAR(state->T_odom_base.linear()(1, 0), 1, 1e-12);
  EXPECT_TRUE(state->covariance.isZero()) << "not flagged";
  EXPECT_FALSE(state->height_m) << "not flagged";
  observer.sequence = 2;
  observer.flags = VSLAM_OBSERVER_HAS_VARIANCE | VSLAM_OBSERVER_HAS_HEIGHT;
  record = recordOf(observer);
  state = input_.read(record.data(), record.size(), 0);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->covariance(0, 0), 0.25);
  EXPECT_EQ(state->covariance(5, 5), 0.25);
  EXPECT_EQ(state->height_m, 1.5);
}

TEST_F(ObserverInputTest, OldNumbersAreDroppedAlsoAcrossTheWrap) {
  EXPECT_TRUE(accepts(odometryAt(1, 0xFFFFFFFEU)));
  EXPECT_FALSE(accepts(odometryAt(2, 0xFFFFFFFEU)));
  EXPECT_FALSE(accepts(odometryAt(3, 0xFFFFFFF0U)));
  EXPECT_TRUE(accepts(odometryAt(4, 1)));
  EXPECT_FALSE(accepts(odometryAt(5, 0xFFFFFFFFU)));
  EXPECT_EQ(input_.counts().old, 3U);
  EXPECT_EQ(input_.counts().accepted, 2U);
}

TEST_F(ObserverInputTest, AControllerThatBeginsAgainIsHeardAfterASilence) {
  EXPECT_TRUE(accepts(odometryAt(1, 5000), 0));
  EXPECT_FALSE(accepts(odometryAt(2, 1), ObserverInput::kForget_ns - 1));
  EXPECT_TRUE(accepts(odometryAt(2, 1), ObserverInput::kForget_ns));
  EXPECT_TRUE(accepts(odometryAt(3, 2), ObserverInput::kForget_ns + 1));
}

TEST_F(ObserverInputTest, WhatCannotBeIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<VslamObserver, 6> wrong;
  wrong.fill(odometryAt(1, 1));
  wrong[0].position_m[2] = nan;
  wrong[1].quaternion[0] = nan;
  wrong[2].quaternion[3] = 1.01;
  wrong[3].variance[4] = std::numeric_limits<double>::infinity();
  wrong[4].height_m = nan;
  wrong[5].stamp_ns = 0;
  for (const VslamObserver& observer : wrong) EXPECT_FALSE(accepts(observer));
  EXPECT_EQ(input_.counts().refused, wrong.size());
  EXPECT_TRUE(accepts(odometryAt(1, 1))) << "a refused record's number is not taken";
}

TEST_F(ObserverInputTest, EachKindOfDamageIsCounted) {
  Record record = recordOf(odometryAt(1, 1));
  EXPECT_FALSE(input_.read(record.data(), 3, 0));
  EXPECT_FALSE(input_.read(record.data(), record.size() - 1, 0));
  record[30] ^= 1;
  EXPECT_FALSE(input_.read(record.data(), record.size(), 0));
  record[4] = 2;
  EXPECT_FALSE(input_.read(record.data(), record.size(), 0));
  EXPECT_EQ(input_.counts().wrong_size, 2U);
  EXPECT_EQ(input_.counts().corrupted, 1U);
  EXPECT_EQ(input_.counts().wrong_kind, 1U);
  EXPECT_EQ(input_.counts().dropped(), 4U);
}

TEST_F(ObserverInputTest, SilenceIsFromTheLastGoodRecord) {
  EXPECT_TRUE(input_.isSilent(0, 0.5));
  EXPECT_TRUE(accepts(odometryAt(1, 1), 0));
  EXPECT_FALSE(input_.isSilent(500 * kMs_ns, 0.5));
  EXPECT_FALSE(accepts(odometryAt(1, 1), 400 * kMs_ns));
  EXPECT_TRUE(input_.isSilent(501 * kMs_ns, 0.5));
}

}  // namespace
}  // namespace ardrone_vslam::test
