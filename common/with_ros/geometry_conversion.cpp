// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/geometry_conversion.hpp"

#include <array>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr double kQuaternionTolerance = 0.1;  // of the norm; drivers round to a few digits
constexpr double kTfTolerance = 10e-3;        // of the squared norm, as in tf2 (buffer_core.cpp)

/// @return the fault
std::string faultOf(const geometry_msgs::TwistWithCovariance& twist) {
  const auto& v = twist.twist.linear;
  const auto& w = twist.twist.angular;
  if (!allFinite(std::array<double, 6>{v.x, v.y, v.z, w.x, w.y, w.z})) {
    return "its twist is not finite; zeros stand for 'unknown'";
  }
  if (!allFinite(twist.covariance)) {
    return "its twist covariance is not finite; all zeros stand for 'unknown'";
  }
  return {};
}

}  // namespace

std::int64_t toNanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.toNSec());
}

ros::Time toRosTime(std::int64_t stamp_ns) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(stamp_ns));
}

Matrix6d toMatrix(const boost::array<double, 36>& row_major) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(row_major.data());
}

void toRowMajor(const Matrix6d& matrix, boost::array<double, 36>& row_major) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(row_major.data()) = matrix;
}

geometry_msgs::Vector3 toVector(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

geometry_msgs::Pose toPose(const Eigen::Isometry3d& T_a_b) {
  const Eigen::Quaterniond q(T_a_b.linear());
  geometry_msgs::Pose pose;
  pose.position.x = T_a_b.translation().x();
  pose.position.y = T_a_b.translation().y();
  pose.position.z = T_a_b.translation().z();
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  pose.orientation.w = q.w();
  return pose;
}

geometry_msgs::Transform toTransform(const Eigen::Isometry3d& T_a_b) {
  geometry_msgs::Transform transform;
  transform.translation = toVector(T_a_b.translation());
  transform.rotation = toPose(T_a_b).orientation;
  return transform;
}

Checked<Eigen::Isometry3d> toIsometry(const geometry_msgs::Pose& pose) {
  const Eigen::Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                             pose.orientation.z);
  if (!p.allFinite()) return {std::nullopt, "its position is not finite"};
  if (!q.coeffs().allFinite()) return {std::nullopt, "its orientation is not finite"};
  if (!(std::abs(q.norm() - 1) < kQuaternionTolerance)) {
    return {std::nullopt, text("its orientation has norm ", q.norm(),
                               " where a unit quaternion is asked for; fill the orientation")};
  }
  Eigen::Isometry3d T_a_b(q.normalized());
  T_a_b.translation() = p;
  return {T_a_b, {}};
}

Checked<Eigen::Isometry3d> toIsometry(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  const auto& q = transform.rotation;
  const double squared_norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(squared_norm - 1) < kTfTolerance)) {
    return {std::nullopt, text("its rotation has norm ", std::sqrt(squared_norm),
                               " and tf takes unit quaternions")};
  }
  return toIsometry(pose);
}

Checked<OdometryState> toUnboundedState(const nav_msgs::Odometry& odometry) {
  const auto T_odom_base = toIsometry(odometry.pose.pose);
  if (!T_odom_base.value) return {std::nullopt, T_odom_base.fault};
  const auto& covariance = odometry.pose.covariance;
  if (!allFinite(covariance)) {
    return {std::nullopt, "its pose covariance is not finite; all zeros stand for 'unknown'"};
  }
  // The map has no use for the twist, but the fused odometry passes it on to controllers.
  const std::string twist_fault = faultOf(odometry.twist);
  if (!twist_fault.empty()) return {std::nullopt, twist_fault};
  if (odometry.header.stamp.isZero()) return {std::nullopt, "its stamp is zero; set header.stamp"};
  OdometryState state;
  state.stamp_ns = toNanoseconds(odometry.header.stamp);
  state.T_odom_base = *T_odom_base.value;
  state.covariance = toMatrix(covariance);
  const auto& twist = odometry.twist.twist;
  state.twist_base << twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x,
      twist.angular.y, twist.angular.z;
  state.twist_covariance = toMatrix(odometry.twist.covariance);
  return {state, {}};
}

}  // namespace ardrone_vslam
