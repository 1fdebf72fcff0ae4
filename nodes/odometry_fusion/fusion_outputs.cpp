// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_fusion/fusion_outputs.hpp"

#include <nav_msgs/Path.h>

namespace ardrone_vslam {

void FusionOutputs::advertise(ros::NodeHandle& nh) {
  constexpr std::uint32_t kLiveQueue = 2000;  // 10 s at 200 Hz
  live_ = nh.advertise<nav_msgs::Odometry>("odometry_live", kLiveQueue);
  repropagated_ = nh.advertise<nav_msgs::Path>("repropagated", 10);
}

void FusionOutputs::publishLive(const DelayedFusion& fusion, const Frames& frames) {
  if (const auto live = fusion.newest()) live_.publish(toOdometryMessage(*live, frames));
}

void FusionOutputs::publishRepropagated(const DelayedFusion& fusion, const Frames& frames) {
  if (repropagated_.getNumSubscribers() == 0) return;
  nav_msgs::Path path;
  for (const MapState& state : fusion.sinceCorrection()) {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = toRosTime(state.stamp_ns);
    pose.header.frame_id = frames.map;
    pose.pose = toPose(state.T_map_base);
    path.poses.push_back(pose);
  }
  path.header.stamp = toRosTime(fusion.correctionStamp_ns());
  path.header.frame_id = frames.map;
  repropagated_.publish(path);
}

}  // namespace ardrone_vslam
