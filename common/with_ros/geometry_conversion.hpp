// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <boost/array.hpp>
#include <cstdint>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

std::int64_t toNanoseconds(const ros::Time& time);
ros::Time toRosTime(std::int64_t stamp_ns);

/// ROS has 6 x 6 covariances row by row: position, then rotation about the fixed axes.
Matrix6d toMatrix(const boost::array<double, 36>& row_major);
void toRowMajor(const Matrix6d& matrix, boost::array<double, 36>& row_major);

geometry_msgs::Vector3 toVector(const Eigen::Vector3d& vector);
geometry_msgs::Pose toPose(const Eigen::Isometry3d& T_a_b);
geometry_msgs::Transform toTransform(const Eigen::Isometry3d& T_a_b);

/// Its quaternion is normalised; a norm off by 10 % or more is a fault.
Checked<Eigen::Isometry3d> toIsometry(const geometry_msgs::Pose& pose);
/// The same within what tf2 takes, which is half a per cent: it refuses the others, with lines.
Checked<Eigen::Isometry3d> toIsometry(const geometry_msgs::Transform& transform);

/// Pose of base in odom, however far away (rangeFault): for the nodelets and for the tools that
/// read bags, so that both judge a message alike. The covariance is the message's, also one that
/// counts as not given (covarianceFault).
Checked<OdometryState> toUnboundedState(const nav_msgs::Odometry& odometry);

}  // namespace ardrone_vslam
