// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "with_ros/geometry_conversion.hpp"

namespace ardrone_vslam {

geometry_msgs::TransformStamped toTransformMessage(const Eigen::Isometry3d& T_parent_child,
                                                   const ros::Time& stamp,
                                                   const std::string& parent,
                                                   const std::string& child);

/// One message a state. The twist, in base, is what leads from the state before to this one; states
/// that share a stamp share the twist.
std::vector<nav_msgs::Odometry> toOdometryMessages(const std::vector<OdometryState>& states,
                                                   const std::string& odom_frame,
                                                   const std::string& base_frame);
}  // namespace ardrone_vslam
