// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cstring>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

std_msgs::Header headerOf(std::int64_t stamp_ns, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = toRosTime(stamp_ns);
  header.frame_id = frame;
  return header;
}

geometry_msgs::PoseWithCovariance toPoseWithCovariance(const FrameResult& result) {
  geometry_msgs::PoseWithCovariance pose;
  pose.pose = toPose(result.T_map_base);
  toRowMajor(result.covariance, pose.covariance);
  return pose;
}

void fillTwist(const Vector6d& twist, const Matrix6d& covariance,
               geometry_msgs::TwistWithCovariance& message) {
  message.twist.linear.x = twist[0];
  message.twist.linear.y = twist[1];
  message.twist.linear.z = twist[2];
  message.twist.angular.x = twist[3];
  message.twist.angular.y = twist[4];
  message.twist.angular.z = twist[5];
  toRowMajor(covariance, message.covariance);
}

}  // namespace

void toMessage(const ImageFeatures& features, const std::string& camera_frame, Features& message) {
  message.header = headerOf(features.stamp_ns, camera_frame);
  message.width = static_cast<std::uint32_t>(features.width_px);
  message.height = static_cast<std::uint32_t>(features.height_px);
  message.focal_length = features.focal_length_px;
  const std::size_t count = features.size();
  message.x.resize(count);
  message.y.resize(count);
  message.bearing.resize(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    message.x[i] = features.pixel_px[i].x();
    message.y[i] = features.pixel_px[i].y();
    for (int axis = 0; axis < 3; ++axis) {
      message.bearing[3 * i + static_cast<std::size_t>(axis)] = features.bearing_cam[i][axis];
    }
  }
  message.score = features.score;
  message.track_id = features.track_id;
  message.age = features.age_frames;
  message.information.clear();
  for (const PixelInformation& known : features.information)
    message.information.insert(message.information.end(),
                               {known.xx_per_px2, known.xy_per_px2, known.yy_per_px2});
  message.residual = features.residual;
  message.descriptor.resize(sizeof(Descriptor) * features.descriptor.size());
  if (!message.descriptor.empty()) {
    std::memcpy(message.descriptor.data(), features.descriptor.data(), message.descriptor.size());
  }
}

geometry_msgs::PoseWithCovarianceStamped toPoseMessage(const FrameResult& result,
                                                       const Frames& frames) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = headerOf(result.stamp_ns, frames.map);
  message.pose = toPoseWithCovariance(result);
  return message;
}

nav_msgs::Odometry toOdometryMessage(const FrameResult& result, const Frames& frames,
                                     const OdometryState& odometry) {
  nav_msgs::Odometry message;
  message.header = headerOf(result.stamp_ns, frames.map);
  message.child_frame_id = frames.base;
  message.pose = toPoseWithCovariance(result);
  fillTwist(odometry.twist_base, odometry.twist_covariance, message.twist);
  return message;
}

nav_msgs::Odometry toOdometryMessage(const MapState& state, const Frames& frames) {
  nav_msgs::Odometry message;
  message.header = headerOf(state.stamp_ns, frames.map);
  message.child_frame_id = frames.base;
  message.pose.pose = toPose(state.T_map_base);
  toRowMajor(state.covariance, message.pose.covariance);
  fillTwist(state.twist_base, state.twist_covariance, message.twist);
  return message;
}

nav_msgs::Odometry toOdometryMessage(const OdometryState& state, const std::string& odom_frame,
                                     const std::string& base_frame) {
  nav_msgs::Odometry message;
  message.header = headerOf(state.stamp_ns, odom_frame);
  message.child_frame_id = base_frame;
  message.pose.pose = toPose(state.T_odom_base);
  toRowMajor(state.covariance, message.pose.covariance);
  fillTwist(state.twist_base, state.twist_covariance, message.twist);
  return message;
}

PoseCorrection toCorrectionMessage(const FrameResult& result, const Eigen::Isometry3d& T_map_odom,
                                   const Frames& frames) {
  PoseCorrection message;
  message.header = headerOf(result.stamp_ns, frames.map);
  message.child_frame_id = frames.base;
  message.observer_pose = toPose(result.T_odom_base);
  message.fused_pose = toPoseWithCovariance(result);
  message.map_to_odom = toTransform(T_map_odom);
  message.deviation = result.sigma_m;
  const bool is_by_camera =
      result.state == SlamState::kLocalised || result.state == SlamState::kTracking ||
      result.state == SlamState::kResting || result.state == SlamState::kRotating ||
      result.state == SlamState::kRelocated;
  const bool had_no_time = isLeftOut(OptionalWork::kLandmarks, result.left_out) &&
                           isLeftOut(OptionalWork::kKeyframe, result.left_out);
  message.corrected = is_by_camera && !had_no_time;
  return message;
}

sensor_msgs::PointCloud2 toCloud(const Landmarks& landmarks, const std::string& map_frame,
                                 std::int64_t stamp_ns) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header = headerOf(stamp_ns, map_frame);
  cloud.height = 1;
  cloud.is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(6, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "deviation", 1, PointField::FLOAT32,
                                "times_seen", 1, PointField::UINT32, "id", 1, PointField::UINT32);
  modifier.resize(landmarks.size());
  sensor_msgs::PointCloud2Iterator<float> xyzd(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint32_t> seen_id(cloud, "times_seen");
  for (const Landmark& landmark : landmarks) {
    for (int axis = 0; axis < 3; ++axis)
      xyzd[axis] = static_cast<float>(landmark.position_map[axis]);
    xyzd[3] = landmark.sigma_m;
    seen_id[0] = static_cast<std::uint32_t>(landmark.times_seen);
    seen_id[1] = landmark.id;
    ++xyzd;
    ++seen_id;
  }
  return cloud;
}

}  // namespace ardrone_vslam
