// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <vector>

namespace ardrone_vslam {

/// What a node does again and again, by wall time, in the queue of its node handle.
class Timers {
 public:
  void every(ros::NodeHandle& nh, double period_s, const std::function<void()>& action) {
    timers_.push_back(nh.createWallTimer(ros::WallDuration(period_s),
                                         [action](const ros::WallTimerEvent&) { action(); }));
  }

 private:
  std::vector<ros::WallTimer> timers_;
};

}  // namespace ardrone_vslam
