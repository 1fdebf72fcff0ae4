// SPDX-License-Identifier: BSD-3-Clause
#include "timing/clock_watch.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

class ClockWatchTest : public testing::Test {
 protected:
  ClockWatchTest() { ros::Time::init(); }
  void TearDown() override { ros::Time::init(); }  // the wall's again
  ClockWatch watch_;
};

TEST_F(ClockWatchTest, AClockThatMovesDoesNotStand) {
  for (int second = 1; second < 15; ++second) {
    ros::Time::setNow(ros::Time(second));
    EXPECT_FALSE(watch_.endSecond());
    EXPECT_EQ(watch_.fault(), "");
  }
}

TEST_F(ClockWatchTest, WithoutAClockThatIsSaidOnce) {
  ros::Time::setNow(ros::Time(0));
  int said = 0;
  for (int second = 1; second < 60; ++second) {
    EXPECT_TRUE(watch_.endSecond());
    said += watch_.fault().find("use_sim_time") != std::string::npos;
  }
  EXPECT_EQ(said, 1);
}

TEST_F(ClockWatchTest, ABagThatIsPausedOrAtItsEndIsNoFault) {
  ros::Time::setNow(ros::Time(100));
  EXPECT_FALSE(watch_.endSecond());
  for (int second = 1; second < 60; ++second) {
    EXPECT_TRUE(watch_.endSecond());
    EXPECT_EQ(watch_.fault(), "");
  }
}

TEST_F(ClockWatchTest, TheWallsClockNeverStands) {
  EXPECT_FALSE(watch_.endSecond());
  EXPECT_FALSE(watch_.endSecond());
}

TEST_F(ClockWatchTest, AReminderIsDueAfterThreeSecondsInWhichTheClockMoves) {
  Reminder reminder;
  ros::Time::setNow(ros::Time(7));
  for (int second = 0; second < 40; ++second) EXPECT_FALSE(reminder.isDue(true)) << second;
  for (int second = 1; second <= 30; ++second) {
    ros::Time::setNow(ros::Time(7 + second));
    EXPECT_EQ(reminder.isDue(true), second == 3 || second == 30) << second;
  }
  ros::Time::setNow(ros::Time(60));
  EXPECT_FALSE(reminder.isDue(false));
}

}  // namespace
}  // namespace ardrone_vslam
