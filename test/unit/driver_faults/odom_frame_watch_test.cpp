// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/odom_frame_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/driver_faults/adapter_flight.hpp"

namespace ardrone_vslam::test {
namespace {

class OdomFrameWatchTest : public AdapterFlight {};

/// In another frame from `from` on.
void moveFrame(const Eigen::Isometry3d& T_new_old, std::size_t from,
               std::vector<OdometryState>& messages) {
  for (std::size_t i = from; i < messages.size(); ++i)
    messages[i].T_odom_base = T_new_old * messages[i].T_odom_base;
}

Eigen::Isometry3d levelFrame(double yaw_rad, double x_m, double y_m) {
  return Eigen::Translation3d(x_m, y_m, 0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

TEST_F(OdomFrameWatchTest, AHeadingThatJumpsGoesOnAndIsCounted) {
  for (const double jump_rad : {-3.0, -0.5, 0.5, 1.5}) {
    for (const bool bursts : {false, true}) {
      Faults faults;
      faults.bursts = bursts;
      auto messages = messagesOf(faults);
      moveFrame(levelFrame(jump_rad, 1, -2), 6000, messages);
      for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
        if (bursts && mode == OdometryMode::kPose) continue;  // poses of a burst stay bunched
        feed(messages, mode);
        EXPECT_EQ(count(OdometryFault::kTurn), 1U) << jump_rad;
        EXPECT_LT(worst_m(), 0.06) << jump_rad << (bursts ? ", bursts" : "");
        const double turn_rad = Eigen::AngleAxisd(truthAt(59.995).T_odom_base.linear().transpose() *
                                                  states_.back().T_odom_base.linear())
                                    .angle();
        EXPECT_LT(turn_rad, 0.03) << jump_rad;
        EXPECT_EQ(states_.back().start, 0U);
      }
    }
  }
}

TEST_F(OdomFrameWatchTest, AHeadingThatCatchesUpAfterAFreezeIsBelieved) {
  auto messages = messagesOf({});
  for (std::size_t i = 1000; i < 2000; ++i) {
    messages[i].T_odom_base = messages[999].T_odom_base;
    messages[i].twist_base = messages[999].twist_base;
  }
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 0U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
}

TEST_F(OdomFrameWatchTest, ASingleMessageOfNonsenseTurnsNothing) {
  auto messages = messagesOf({});
  messages[600].T_odom_base = levelFrame(2, 30, 40) * messages[600].T_odom_base;
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 2U);
  EXPECT_LT(worst_m(), 0.03);
  EXPECT_EQ(states_.back().start, 0U);
}

TEST_F(OdomFrameWatchTest, TwoMessagesOfNonsenseAreNoOtherFlight) {
  auto messages = messagesOf({});
  for (const std::size_t i : {1000, 3000})
    messages[i].T_odom_base = levelFrame(2, 30, 40) * messages[i].T_odom_base;
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 4U);
  EXPECT_LT(worst_m(), 0.05);
  EXPECT_EQ(states_.back().start, 0U);
}

TEST_F(OdomFrameWatchTest, NeitherWrongUnitsNorStampsThatAreNearlyEqualTurnAnything) {
  for (const double unit : {0.0, 180 / M_PI}) {
    for (const std::int64_t apart_ns : {100'000, 1'000'000}) {
      auto messages = messagesOf({});
      for (std::size_t i = 0; i < messages.size(); ++i) {
        messages[i].twist_base[5] = 0.5 * unit;
        // What came in 0.25 s is handed over at its end.
        const std::size_t end = i - i % 50 + 49;
        messages[i].stamp_ns = truthAt(static_cast<double>(end) * kStep_s).stamp_ns -
                               static_cast<std::int64_t>(end - i) * apart_ns;
      }
      feed(messages, OdometryMode::kPose);
      EXPECT_EQ(count(OdometryFault::kTurn), 0U) << unit << ", " << apart_ns;
      EXPECT_EQ(states_.back().start, 0U);
    }
  }
}

TEST_F(OdomFrameWatchTest, AfterAnotherFlightsOdometryThePlaceIsUnknown) {
  auto messages = messagesOf({});
  moveFrame(levelFrame(2, 3, 4), 1000, messages);
  moveFrame(levelFrame(2, 3, 4).inverse(), 2000, messages);
  feed(messages, OdometryMode::kPose);
  EXPECT_EQ(count(OdometryFault::kTurn), 2U);
  EXPECT_EQ(states_.front().start, 0U);
  EXPECT_EQ(states_[1999].start, 0U);
  EXPECT_EQ(states_[2000].start, 1U);
  EXPECT_EQ(states_.back().T_odom_base.matrix(), messages.back().T_odom_base.matrix());
}

TEST_F(OdomFrameWatchTest, AfterAGapAPoseAtTheOriginIsANewStart) {
  const auto withGap = [](double gap_s, const Eigen::Isometry3d& T_start) {
    auto messages = messagesOf({});
    const auto again = static_cast<std::size_t>(1000 + std::lround(gap_s / kStep_s));
    const Eigen::Isometry3d& there = messages[again].T_odom_base;
    Eigen::Isometry3d T_origin_odom = Eigen::Isometry3d::Identity();
    T_origin_odom.linear() =
        Eigen::AngleAxisd(-std::atan2(there(1, 0), there(0, 0)), Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    T_origin_odom.translation() = -(T_origin_odom.linear() * there.translation());
    moveFrame(T_start * T_origin_odom, again, messages);
    messages.erase(messages.begin() + 1000, messages.begin() + static_cast<std::ptrdiff_t>(again));
    return messages;
  };
  for (const auto mode : {OdometryMode::kPose, OdometryMode::kTwist}) {
    feed(withGap(2, levelFrame(0.01, 0.02, 0)), mode);
    EXPECT_EQ(count(OdometryFault::kStartedAgain), 1U);
    EXPECT_EQ(count(OdometryFault::kHole), 0U) << "the way in it is not lost, all is";
    EXPECT_EQ(states_[999].start, 0U);
    EXPECT_EQ(states_[1000].start, 1U);
    EXPECT_LT(states_[1000].T_odom_base.translation().head<2>().norm(), 0.021);
    EXPECT_EQ(states_.back().start, 1U);
    for (const auto& messages :
         {withGap(2, levelFrame(0, 0.1, 0)), withGap(2, levelFrame(0.1, 0, 0)),
          withGap(0.4, levelFrame(0, 0, 0))}) {
      feed(messages, mode);
      EXPECT_EQ(count(OdometryFault::kStartedAgain), 0U);
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
