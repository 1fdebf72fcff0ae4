// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <string>

#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// Whether ROS time stands still, with /use_sim_time: before a bag begins, while it is paused and
/// after its end nothing is missing that a warning should name, but perhaps /clock itself.
class ClockWatch {
 public:
  /// To be called once a second.
  /// @return whether ROS time stood still since the call before
  bool endSecond() {
    const ros::Time now = ros::Time::now();
    const bool stands = ros::Time::isSimTime() && now == before_;
    before_ = now;
    seconds_ = stands ? seconds_ + 1 : 0;
    return stands;
  }

  /// What to tell a user, once: nobody has published /clock for a while; else empty.
  std::string fault() const {
    constexpr int kPatience_s = 10;  // a player takes some seconds to find its subscribers
    if (seconds_ != kPatience_s || !before_.isZero()) return {};
    return "/use_sim_time is set, but nobody publishes /clock: play the bag with --clock, or "
           "`rosparam set use_sim_time false` and start the nodes again";
  }

 private:
  ros::Time before_;
  int seconds_ = 0;
};

/// When to remind of what one waits for (isReminderDue): not while ROS time stands still.
class Reminder {
 public:
  /// To be called once a second, with whether one waits for anything.
  bool isDue(bool waits) {
    const bool counts = !clock_.endSecond() && waits;
    seconds_waiting_ = counts ? seconds_waiting_ + 1 : 0;
    return isReminderDue(seconds_waiting_);
  }

 private:
  ClockWatch clock_;
  int seconds_waiting_ = 0;
};

}  // namespace ardrone_vslam
