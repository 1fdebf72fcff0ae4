// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Path.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>

#include <pluginlib/class_list_macros.hpp>

#include "with_ros/params.hpp"

namespace ardrone_vslam {

namespace {

constexpr std::size_t kMostPoses = 100000;  // eight minutes at 200 a second; then it begins anew
constexpr double kPeriod_s = 0.5;           // of publishing: a path is sent whole each time

}  // namespace

/// Poses in, their path out: rviz shows a path, but of a pose only the newest. For the truth that
/// bags carry.
class PathNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const ParamReader reader(getPrivateNodeHandle());  // it has none
    for (const auto& sentence : reader.unknownKeys()) NODELET_WARN_STREAM(sentence);
    ros::NodeHandle& nh = getNodeHandle();
    path_pub_ = nh.advertise<nav_msgs::Path>("path", 1);
    pose_sub_ = nh.subscribe("pose", 1000, &PathNodelet::onPose, this);
    timer_ = nh.createWallTimer(ros::WallDuration(kPeriod_s),
                                [this](const ros::WallTimerEvent&) { publish(); });
  }

  void onPose(const geometry_msgs::PoseStampedConstPtr& pose) {
    auto& poses = path_.poses;
    const bool is_restart = !poses.empty() && pose->header.stamp < poses.back().header.stamp;
    if (is_restart || poses.size() >= kMostPoses) poses.clear();
    poses.push_back(*pose);
    path_.header = pose->header;
    is_new_ = true;
  }

  void publish() {
    const std::uint32_t subscribers = path_pub_.getNumSubscribers();
    if (subscribers > subscribers_ || (is_new_ && subscribers > 0)) path_pub_.publish(path_);
    if (subscribers > 0) is_new_ = false;
    subscribers_ = subscribers;
  }

  ros::Subscriber pose_sub_;
  ros::Publisher path_pub_;
  ros::WallTimer timer_;
  nav_msgs::Path path_;
  bool is_new_ = false;
  std::uint32_t subscribers_ = 0;
};

}  // namespace ardrone_vslam

PLUGINLIB_EXPORT_CLASS(ardrone_vslam::PathNodelet, nodelet::Nodelet)
