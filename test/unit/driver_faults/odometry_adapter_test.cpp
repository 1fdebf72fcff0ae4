// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_adapter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "unit/driver_faults/adapter_flight.hpp"

namespace ardrone_vslam::test {
namespace {

using Push = OdometryBuffer::Push;
class OdometryAdapterTest : public AdapterFlight {};

TEST_F(OdometryAdapterTest, SoundOdometryPassesPoseModeToTheBit) {
  std::vector<OdometryState> messages = messagesOf({});
  for (OdometryState& message : messages) message.covariance = 0.1 * Matrix6d::Identity();
  feed(messages, OdometryMode::kPose);
  ASSERT_EQ(states_.size(), messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(states_[i].stamp_ns, messages[i].stamp_ns);
    EXPECT_EQ(states_[i].T_odom_base.matrix(), messages[i].T_odom_base.matrix());
    EXPECT_EQ(states_[i].covariance, messages[i].covariance);
    EXPECT_EQ(states_[i].twist_base, messages[i].twist_base);
  }
  EXPECT_EQ(adapter_->faults(), OdometryFaultCounts{});
  EXPECT_EQ(refused_, 0);
}

TEST_F(OdometryAdapterTest, APerfectTwistGivesThePoseToTheIntegrationsError) {
  // Trapezoid: chords instead of arcs, a share of (turn rate * interval)^2 / 12 of the radius.
  feed(messagesOf({}), OdometryMode::kTwist);
  EXPECT_NEAR(worst_m(), 2 * 2.0 * std::pow(0.5 * 0.005, 2) / 12, 1e-9) << "across the circle";
  EXPECT_LT(worstHeight_m(), 1e-12);
  feed(messagesOf({}), OdometryMode::kTwist, OdometryHeight::kTwist);
  EXPECT_LT(worstHeight_m(), 1e-5);
}

TEST_F(OdometryAdapterTest, AMirroredYawHarmsThePoseAndNotTheTwist) {
  const auto messages = messagesOf({/*mirrored_yaw=*/true});
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(worst_m(), 5);
  feed(messages, OdometryMode::kTwist);
  EXPECT_LT(worst_m(), 0.01);
}

TEST_F(OdometryAdapterTest, AnEpochJumpIsNoMotionAndCountedOnce) {
  Faults faults;
  faults.epoch_at_s = 20;
  const auto messages = messagesOf(faults);
  ASSERT_GT(messages.back().T_odom_base.translation().norm(), 1e9);
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worst_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kJump), 1U);
    EXPECT_EQ(refused_, 1) << "the first message after it might be nonsense";
  }
}

TEST_F(OdometryAdapterTest, AHeightThatBeginsAnewWithTheJumpGoesOn) {
  Faults faults;
  faults.epoch_at_s = 20;
  auto messages = messagesOf(faults);
  for (std::size_t i = 4000; i < messages.size(); ++i)  // integrated from where it is started
    messages[i].T_odom_base.translation().z() -= 0.7;
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worstHeight_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kJump), 1U);
  }
}

TEST_F(OdometryAdapterTest, ATableBelowIsNoClimb) {
  // The drone's own height reaches the other floor within some tenths of a second.
  const auto messages = [](bool twist_climbs) {
    auto sent = messagesOf({});
    double below_m = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const bool above_table = i > 3000 && i < 5000;
      below_m += ((above_table ? 0.7 : 0) - below_m) * 0.05;
      sent[i].T_odom_base.translation().z() -= below_m;
      if (!twist_climbs) sent[i].twist_base[2] = 0;  // as some firmwares leave it
    }
    return sent;
  };
  feed(messages(true), OdometryMode::kPose);
  EXPECT_GT(worstHeight_m(), 0.65) << "the pose is believed";
  feed(messages(true), OdometryMode::kTwist);
  EXPECT_LT(worstHeight_m(), 0.15) << "what is seen before a step is told";
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.03);
  EXPECT_EQ(count(OdometryFault::kTableStep), 2U);
  feed(messages(false), OdometryMode::kTwist);
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.35) << "climbs during the steps are lost";
  EXPECT_EQ(count(OdometryFault::kTableStep), 2U);
}

TEST_F(OdometryAdapterTest, OdometryThatHasJumpedBeforeBeginsAtItsOrigin) {
  Faults faults;
  faults.epoch_at_s = 20;
  auto messages = messagesOf(faults);
  messages.erase(messages.begin(), messages.begin() + 5000);
  feed(messages, OdometryMode::kPose);
  ASSERT_GT(states_.size(), 6000U);
  EXPECT_LT(states_.front().T_odom_base.translation().head<2>().norm(), 1e-6);
  const Eigen::Vector3d start_m = errorOf_m(states_.front());
  EXPECT_LT((errorOf_m(states_.back()) - start_m).norm(), 0.02);
  EXPECT_EQ(count(OdometryFault::kJump), 1U);
}

TEST_F(OdometryAdapterTest, ALoneMessageFarAwayIsRefused) {
  auto messages = messagesOf({});
  messages[300].T_odom_base.translation().x() = 1e9;
  messages[600].T_odom_base.translation().x() = 1e300;
  messages[900].twist_base[0] = 1e4;
  messages[1200].T_odom_base.translation().y() = std::numeric_limits<double>::quiet_NaN();
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_EQ(refused_, 4);
    EXPECT_EQ(count(OdometryFault::kJump), 0U);
    EXPECT_LT(worst_m(), 0.02);
  }
}

TEST_F(OdometryAdapterTest, APositionThatBeginsAnewGoesOnAndIsCounted) {
  auto messages = messagesOf({});
  const Eigen::Vector3d place_m = messages[1000].T_odom_base.translation();
  for (std::size_t i = 1000; i < messages.size(); ++i)
    messages[i].T_odom_base.translation().head<2>() -= place_m.head<2>();
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messages, mode);
    EXPECT_LT(worst_m(), 0.02);
    EXPECT_EQ(count(OdometryFault::kReset), 1U);
    EXPECT_EQ(refused_, 0);
  }
}

TEST_F(OdometryAdapterTest, StampsThatBeginAnewBeginANewFlight) {
  auto messages = messagesOf({});
  messages.resize(1000);
  OdometryAdapter adapter({OdometryMode::kTwist, OdometryHeight::kPose});
  std::vector<OdometryState> first;
  std::vector<OdometryState> second;
  for (const auto& message : messages) adapter.push(message, first);
  for (const auto& message : messages) EXPECT_EQ(adapter.push(message, second), Push::kAccepted);
  EXPECT_EQ(adapter.faults()[static_cast<std::size_t>(OdometryFault::kRestart)], 1U);
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(second[i].T_odom_base.matrix(), first[i].T_odom_base.matrix());
  // Less than a second back is late, not new.
  EXPECT_EQ(adapter.push(messages[900], second), Push::kBackwardStamp);
}

TEST_F(OdometryAdapterTest, WholeMetresAreToldAndSmoothedByTheTwist) {
  Faults faults;
  faults.whole_metres = true;
  auto messages = messagesOf(faults);
  for (auto& message : messages) message.covariance = 0.01 * Matrix6d::Identity();
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(count(OdometryFault::kWholeMetres), 3U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
  EXPECT_EQ(states_.front().covariance(2, 2), 0.01);
  EXPECT_NEAR(states_.back().covariance(2, 2), 0.01 + 1.0 / 12, 1e-12);
  EXPECT_EQ(states_.back().covariance(0, 0), 0.01);

  feed(messages, OdometryMode::kTwist);
  double fastest_m = 0;
  for (std::size_t i = 1; i < states_.size(); ++i) {
    const double displacement_m = std::abs(states_[i].T_odom_base.translation().z() -
                                           states_[i - 1].T_odom_base.translation().z());
    fastest_m = std::max(fastest_m, displacement_m);
  }
  EXPECT_LT(fastest_m, 0.01) << "no steps";
  double late_error_m = 0;
  for (std::size_t i = states_.size() / 2; i < states_.size(); ++i)
    late_error_m = std::max(late_error_m, std::abs(errorOf_m(states_[i]).z()));
  // They correct the metre that was not known at the beginning by at most 0.03 m/s.
  EXPECT_LT(late_error_m, 0.25) << "the crossings of whole metres tell the height";
  EXPECT_LT(std::abs(errorOf_m(states_.back()).z()), 0.5 * std::abs(errorOf_m(states_[50]).z()));
}

TEST_F(OdometryAdapterTest, ConstantHeightsAreNotWholeMetres) {
  auto messages = messagesOf({});
  for (auto& message : messages) message.T_odom_base.translation().z() = 0;
  feed(messages, OdometryMode::kTwist);
  EXPECT_EQ(count(OdometryFault::kWholeMetres), 0U);
}

TEST_F(OdometryAdapterTest, BurstsAreSpreadOverTheGapBefore) {
  Faults faults;
  faults.bursts = true;
  const auto sound = messagesOf({});
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(messagesOf(faults), mode);
    EXPECT_EQ(count(OdometryFault::kBurst), 1000U);
    EXPECT_EQ(refused_, 0);
    // The first burst's first message is out before it is known as one.
    ASSERT_EQ(states_.size(), sound.size() - 5);
    for (std::size_t i = 1; i < states_.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(states_[i].stamp_ns - sound[i + 5].stamp_ns), 0, 5);
      if (mode == OdometryMode::kTwist) continue;
      EXPECT_EQ(states_[i].T_odom_base.matrix(), sound[i + 5].T_odom_base.matrix()) << i;
    }
  }
  EXPECT_LT(worst_m(), 0.03) << "the first burst's first message, 25 ms late";
  states_.erase(states_.begin());
  EXPECT_LT(worst_m(), 0.001) << "its way is not lost";
}

TEST_F(OdometryAdapterTest, AMessageSentTwiceIsRefusedAndIsNoBurst) {
  auto messages = messagesOf({});
  messages.insert(messages.begin() + 10, messages[9]);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(refused_, 1);
  EXPECT_EQ(count(OdometryFault::kBurst), 0U);
}

TEST_F(OdometryAdapterTest, SilenceAndATwistOfZerosAreNamed) {
  auto messages = messagesOf({});
  messages.erase(messages.begin() + 1000, messages.begin() + 1400);
  feed(messages, OdometryMode::kTwist);
  EXPECT_EQ(count(OdometryFault::kHole), 1U);
  for (auto& message : messages) message.twist_base.setZero();
  feed(messages, OdometryMode::kTwist);
  EXPECT_GE(count(OdometryFault::kNoTwist), 40U);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kNoTwist), 0U) << "nobody needs it";
}

TEST_F(OdometryAdapterTest, ZeroCovariancesAreCountedAndNotWarnedOf) {
  const auto messages = messagesOf({});
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kNoCovariance), messages.size());
  EXPECT_FALSE(positionVariance_m2(states_.back()));
  EXPECT_FALSE(isWorthWarning(OdometryFault::kNoCovariance));
}

TEST_F(OdometryAdapterTest, AllFaultsTogether) {
  Faults faults;
  faults.mirrored_yaw = true;
  faults.epoch_at_s = 20;
  faults.whole_metres = true;
  faults.bursts = true;
  const auto messages = messagesOf(faults);
  feed(messages, OdometryMode::kPose);
  EXPECT_GT(worst_m(), 3);
  feed(messages, OdometryMode::kTwist);
  EXPECT_LT(worst_m(), 0.05);
  EXPECT_EQ(count(OdometryFault::kJump), 1U);
  EXPECT_GT(count(OdometryFault::kBurst), 900U);
  EXPECT_GT(count(OdometryFault::kWholeMetres), 3U);
  EXPECT_EQ(count(OdometryFault::kReset) + count(OdometryFault::kHole), 0U);
}

TEST(OdometryFaults, EachHasASentence) {
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i)
    EXPECT_GT(std::string(explain(static_cast<OdometryFault>(i))).size(), 30U) << i;
}

}  // namespace
}  // namespace ardrone_vslam::test
