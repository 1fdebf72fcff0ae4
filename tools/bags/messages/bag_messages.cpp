// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/bag_messages.hpp"

#include <cmath>

namespace ardrone_vslam {
namespace {

/// Row-major, as ROS has it: position, then rotation about the fixed axes.
using CovarianceMap = Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>;
using ConstCovarianceMap = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>;

geometry_msgs::Vector3 toVectorMessage(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

bool isFinite(const geometry_msgs::TwistWithCovariance& message) {
  const auto& v = message.twist.linear;
  const auto& w = message.twist.angular;
  return Eigen::Vector3d(v.x, v.y, v.z).allFinite() && Eigen::Vector3d(w.x, w.y, w.z).allFinite() &&
         ConstCovarianceMap(message.covariance.data()).allFinite();
}

geometry_msgs::Twist twistBetween(const OdometryState& before, const OdometryState& after) {
  const double dt_s = static_cast<double>(after.stamp_ns - before.stamp_ns) * 1e-9;
  const Eigen::Isometry3d T_before_after = before.T_odom_base.inverse() * after.T_odom_base;
  const Eigen::AngleAxisd angle_axis(T_before_after.linear());
  geometry_msgs::Twist twist;
  twist.linear = toVectorMessage(T_before_after.translation() / dt_s);
  twist.angular = toVectorMessage(angle_axis.axis() * angle_axis.angle() / dt_s);
  return twist;
}

}  // namespace

ros::Time toRosTime(std::int64_t stamp_ns) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(stamp_ns));
}

std::int64_t toNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

geometry_msgs::Pose toPoseMessage(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation(pose.linear());
  geometry_msgs::Pose message;
  message.position.x = pose.translation().x();
  message.position.y = pose.translation().y();
  message.position.z = pose.translation().z();
  message.orientation.x = rotation.x();
  message.orientation.y = rotation.y();
  message.orientation.z = rotation.z();
  message.orientation.w = rotation.w();
  return message;
}

std::optional<Eigen::Isometry3d> fromPoseMessage(const geometry_msgs::Pose& message) {
  const Eigen::Quaterniond rotation(message.orientation.w, message.orientation.x,
                                    message.orientation.y, message.orientation.z);
  const Eigen::Vector3d position(message.position.x, message.position.y, message.position.z);
  // Written so that a norm that is not a number fails, too.
  if (!position.allFinite() || !(std::abs(rotation.norm() - 1) < 0.01)) return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

geometry_msgs::TransformStamped toTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const ros::Time& stamp,
                                                   const std::string& parent,
                                                   const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation = toVectorMessage(T_parent_child.translation());
  message.transform.rotation = toPoseMessage(T_parent_child).orientation;
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
    message.pose.pose = toPoseMessage(state.T_odom_base);
    CovarianceMap(message.pose.covariance.data()) = state.covariance;
    message.twist.twist = twist;
    messages.push_back(message);
  }
  return messages;
}

std::optional<OdometryState> fromOdometryMessage(const nav_msgs::Odometry& message) {
  const auto pose = fromPoseMessage(message.pose.pose);
  const ConstCovarianceMap covariance(message.pose.covariance.data());
  if (!pose || !covariance.allFinite() || !isFinite(message.twist)) return std::nullopt;
  OdometryState state;
  state.stamp_ns = toNanoseconds(message.header.stamp);
  state.T_odom_base = *pose;
  state.covariance = covariance;
  const auto& v = message.twist.twist.linear;
  const auto& w = message.twist.twist.angular;
  state.twist_base << v.x, v.y, v.z, w.x, w.y, w.z;
  state.twist_covariance = ConstCovarianceMap(message.twist.covariance.data());
  return state;
}

}  // namespace ardrone_vslam
