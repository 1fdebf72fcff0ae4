// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tf_buffer.hpp"

#include <console_bridge/console.h>
#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

/// What tf2 says.
class Said : public console_bridge::OutputHandler {
 public:
  Said() { console_bridge::useOutputHandler(this); }
  ~Said() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& line, console_bridge::LogLevel, const char*, int) override {
    text += line + "\n";
  }
  std::string text;
};

tf2_msgs::TFMessage transform(const std::string& parent, const std::string& child, double stamp_s,
                              double x_m = 0) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header.frame_id = parent;
  message.transforms[0].header.stamp = ros::Time(stamp_s);
  message.transforms[0].child_frame_id = child;
  message.transforms[0].transform.translation.x = x_m;
  message.transforms[0].transform.rotation.w = 1;
  return message;
}

double x_m(const TfBuffer& tf, double stamp_s) {
  return tf.core().lookupTransform("odom", "base", ros::Time(stamp_s)).transform.translation.x;
}

TEST(TfBuffer, BurstsOfOneStampAreCountedAndNotWarnedOf) {
  const Said said;
  TfBuffer tf;
  const ros::Time now(100);
  for (const double stamp_s : {100.0, 100.03}) {
    for (int packet = 0; packet < 6; ++packet)
      tf.take(transform("odom", "base", stamp_s, stamp_s + packet), "driver", false, now);
  }
  tf.take(transform("odom", "/base", 100.0), "driver", false, now);  // late, with tf1's slash
  EXPECT_EQ(said.text, "");
  EXPECT_EQ(tf.repeated(), 11U);
  EXPECT_EQ(x_m(tf, 100.03), 100.03) << "the first of a stamp counts, as in tf2";
  // Of another frame it is no repetition; in between there is none yet.
  tf.take(transform("base", "camera", 100.03), "driver", false, now);
  tf.take(transform("odom", "base", 100.01, 7), "driver", false, now);
  EXPECT_EQ(tf.repeated(), 11U);
  EXPECT_EQ(x_m(tf, 100.01), 7);
}

TEST(TfBuffer, StaticTransformsMayComeAgainAndStay) {
  const Said said;
  TfBuffer tf;
  for (const double x : {1.0, 2.0}) {
    tf.take(transform("odom", "base", 5, x), "mounting", true, ros::Time(100));
  }
  tf.clear();
  EXPECT_EQ(x_m(tf, 0), 2);
  EXPECT_EQ(tf.repeated(), 0U);
  EXPECT_EQ(said.text, "");
}

TEST(TfBuffer, WhatIsOlderThanAllKeptIsCounted) {
  const Said said;
  TfBuffer tf;
  tf.take(transform("odom", "base", 100, 1), "driver", false, ros::Time(100));
  tf.take(transform("odom", "base", 89, 2), "driver", false, ros::Time(100));
  EXPECT_EQ(tf.tooOld(), 1U);
  EXPECT_EQ(x_m(tf, 0), 1);
  EXPECT_EQ(said.text, "");
  tf.clear();  // a bag that plays again without /clock
  tf.take(transform("odom", "base", 89, 3), "driver", false, ros::Time(101));
  EXPECT_EQ(x_m(tf, 0), 3);
  EXPECT_EQ(tf.tooOld(), 1U);
}

TEST(TfBuffer, ForgetsWhenTheClockGoesBack) {
  const Said said;
  TfBuffer tf;
  tf.take(transform("odom", "base", 50, 1), "driver", false, ros::Time(50));
  tf.take(transform("odom", "base", 99, 1), "driver", false, ros::Time(99));
  tf.take(transform("odom", "base", 50, 2), "driver", false, ros::Time(50));  // the second round
  EXPECT_EQ(x_m(tf, 0), 2);
  EXPECT_EQ(tf.repeated(), 0U);
  EXPECT_EQ(tf.tooOld(), 0U);
  EXPECT_EQ(said.text, "");
}

TEST(OdomFrameFault, NamesThePrefixThatTheOdometryLeavesOut) {
  TfBuffer tf;
  const auto fault = [&tf](const std::string& odom, const std::string& base) {
    return odomFrameFault(tf.core(), "map", odom, base);
  };
  EXPECT_EQ(fault("odom", "drone1/base"), "") << "tf says nothing";
  tf.take(transform("drone1/odom", "drone1/base", 1), "driver", false, ros::Time(1));
  EXPECT_EQ(fault("drone1/odom", "drone1/base"), "");
  const std::string said = fault("odom", "drone1/base");
  EXPECT_NE(said.find("tf that it lies in drone1/odom"), std::string::npos) << said;
  EXPECT_NE(said.find("set tf_prefix to drone1, or the mapper's odom_frame to drone1/odom"),
            std::string::npos)
      << said;
  EXPECT_NE(fault("world", "drone1/base").find("set the mapper's odom_frame to drone1/odom"),
            std::string::npos);
}

TEST(OdomFrameFault, NotOfFramesInBetween) {
  TfBuffer tf;
  tf.take(transform("odom", "footprint", 1), "robot", false, ros::Time(1));
  tf.take(transform("footprint", "base", 1), "robot", false, ros::Time(1));
  EXPECT_EQ(odomFrameFault(tf.core(), "map", "odom", "base"), "");
  // Somebody else sends its place in map itself: it lies in the tree all the same.
  EXPECT_EQ(odomFrameFault(tf.core(), "odom", "wheels", "base"), "");
}

}  // namespace
}  // namespace ardrone_vslam
