// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"

namespace ardrone_vslam {

ros::Time toRosTime(std::int64_t stamp_ns);
std::int64_t toNanoseconds(const ros::Time& time);

geometry_msgs::Pose toPoseMessage(const Eigen::Isometry3d& pose);
/// @return nothing when the pose is not finite or its quaternion is no rotation (norm off by more
/// than 1 %)
std::optional<Eigen::Isometry3d> fromPoseMessage(const geometry_msgs::Pose& message);

geometry_msgs::TransformStamped toTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const ros::Time& stamp,
                                                   const std::string& parent,
                                                   const std::string& child);

/// One message a state. The twist, in base, is what leads from the state before to this one; states
/// that share a stamp share the twist.
std::vector<nav_msgs::Odometry> toOdometryMessages(const std::vector<OdometryState>& states,
                                                   const std::string& odom_frame,
                                                   const std::string& base_frame);
/// @return nothing when pose, twist or their covariances are not finite, as the nodelets
std::optional<OdometryState> fromOdometryMessage(const nav_msgs::Odometry& message);

}  // namespace ardrone_vslam
