// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/bag_messages.hpp"

namespace ardrone_vslam {
namespace {

geometry_msgs::Twist twistBetween(const OdometryState& before, const OdometryState& after) {
  const double dt_s = static_cast<double>(after.stamp_ns - before.stamp_ns) * 1e-9;
  const Eigen::Isometry3d T_before_after = before.T_odom_base.inverse() * after.T_odom_base;
  const Eigen::AngleAxisd angle_axis(T_before_after.linear());
  geometry_msgs::Twist twist;
  twist.linear = toVector(T_before_after.translation() / dt_s);
  twist.angular = toVector(angle_axis.axis() * angle_axis.angle() / dt_s);
  return twist;
}

}  // namespace

geometry_msgs::TransformStamped toTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const ros::Time& stamp,
                                                   const std::string& parent,
                                                   const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform = toTransform(T_parent_child);
  return message;
}

std::vector<nav_msgs::Odometry> toOdometryMessages(const std::vector<OdometryState>& states,
                                                   const std::string& odom_frame,
                                                   const std::string& base_frame) {
  std::vector<nav_msgs::Odometry> messages;
  messages.reserve(states.size());
  geometry_msgs::Twist twist;
  const OdometryState* before = states.empty() ? nullptr : &states.front();
  for (const OdometryState& state : states) {
    if (state.stamp_ns > before->stamp_ns) {
      twist = twistBetween(*before, state);
      before = &state;
    }
    nav_msgs::Odometry message;
    message.header.stamp = toRosTime(state.stamp_ns);
    message.header.frame_id = odom_frame;
    message.child_frame_id = base_frame;
    message.pose.pose = toPose(state.T_odom_base);
    toRowMajor(state.covariance, message.pose.covariance);
    message.twist.twist = twist;
    messages.push_back(message);
  }
  return messages;
}

}  // namespace ardrone_vslam
