// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <vector>

namespace ardrone_vslam {

/// What a node does again and again, or soon, by wall time, in the queue of its node handle.
class Timers {
 public:
  void every(ros::NodeHandle& nh, double period_s, const std::function<void()>& action) {
    timers_.push_back(nh.createWallTimer(ros::WallDuration(period_s),
                                         [action](const ros::WallTimerEvent&) { action(); }));
  }
  /// As soon as that queue comes to it, beside none of its other callbacks.
  void once(ros::NodeHandle& nh, const std::function<void()>& action) {
    constexpr bool kOneShot = true, kStarts = false;
    ros::WallTimer timer = nh.createWallTimer(
        ros::WallDuration(0), [action](const ros::WallTimerEvent&) { action(); }, kOneShot,
        kStarts);
    timers_.push_back(timer);
    timer.start();  // last: the action may add timers, in its thread
  }

 private:
  std::vector<ros::WallTimer> timers_;
};

}  // namespace ardrone_vslam
