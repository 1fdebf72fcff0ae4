// SPDX-License-Identifier: BSD-3-Clause
#include "outputs/mapper_outputs.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kQueue = 100;
constexpr std::size_t kMostPathPoses = 5000;  // a path is sent whole; the oldest go first

}  // namespace

MapperOutputs::MapperOutputs(ros::NodeHandle& nh, const OutputsConfig& config)
    : config_(config),
      pose_pub_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", kQueue)),
      odometry_pub_(nh.advertise<nav_msgs::Odometry>("odometry_fused", kQueue)),
      correction_pub_(nh.advertise<PoseCorrection>("correction", kQueue)),
      view_(nh) {
  path_.publisher = nh.advertise<nav_msgs::Path>("path", 1);
  odometry_path_.publisher = nh.advertise<nav_msgs::Path>("observer_path", 1);
  cloud_.publisher = nh.advertise<sensor_msgs::PointCloud2>("landmarks", 1);
}

void MapperOutputs::publishFrame(const FrameResult& result, const Eigen::Isometry3d& T_map_odom,
                                 const Frames& frames, const OdometryState& odometry) {
  newest_ns_ = result.stamp_ns;
  pose_pub_.publish(toPoseMessage(result, frames));
  odometry_pub_.publish(toOdometryMessage(result, frames, odometry));
  PoseCorrection correction = toCorrectionMessage(result, T_map_odom, frames);
  correction.header.stamp = toRosTime(odometry.stamp_ns);  // of the odometry it corrects
  correction_pub_.publish(correction);
  // At the first image map equals odom, so in map the odometry's own poses show its drift.
  remember(fused_poses_, result.T_map_base, frames);
  remember(odometry_poses_, result.T_odom_base, frames);
}

void MapperOutputs::publishTf(std::int64_t stamp_ns, const Eigen::Isometry3d& T_map_odom,
                              const Frames& frames) {
  if (!config_.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = toRosTime(stamp_ns) + ros::Duration(config_.transform_tolerance_s);
  transform.header.frame_id = frames.map;
  transform.child_frame_id = frames.odom;
  transform.transform = toTransform(T_map_odom);
  broadcaster_.sendTransform(transform);
}

void MapperOutputs::publishMap(const Landmarks& landmarks, const std::string& map_frame) {
  if (path_.isDue(newest_ns_)) path_.publisher.publish(toPath(fused_poses_));
  if (odometry_path_.isDue(newest_ns_)) odometry_path_.publisher.publish(toPath(odometry_poses_));
  if (cloud_.isDue(newest_ns_)) cloud_.publisher.publish(toCloud(landmarks, map_frame, newest_ns_));
  std_msgs::Header header;
  header.stamp = toRosTime(newest_ns_);
  header.frame_id = map_frame;
  view_.publishLandmarks(landmarks, header, base_map());
}

void MapperOutputs::publishState(const Status& status, const Landmarks& landmarks) {
  view_.publishState(status, base_map(), landmarks);
}

Eigen::Vector3d MapperOutputs::base_map() const {
  if (fused_poses_.empty()) return Eigen::Vector3d::Zero();
  const geometry_msgs::Point& at = fused_poses_.back().pose.position;
  return {at.x, at.y, at.z};
}

void MapperOutputs::clear() {
  fused_poses_.clear();
  odometry_poses_.clear();
}

bool MapperOutputs::OnDemand::isDue(std::int64_t newest_ns) {
  const std::uint32_t subscribers_before = subscribers;
  subscribers = publisher.getNumSubscribers();
  if (newest_ns == 0 || subscribers == 0) return false;
  if (newest_ns == published_ns && subscribers <= subscribers_before) return false;
  published_ns = newest_ns;
  return true;
}

void MapperOutputs::remember(Poses& poses, const Eigen::Isometry3d& T_a_b, const Frames& frames) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = toRosTime(newest_ns_);
  pose.header.frame_id = frames.map;
  pose.pose = toPose(T_a_b);
  poses.push_back(pose);
  if (poses.size() > kMostPathPoses) poses.pop_front();
}

nav_msgs::Path MapperOutputs::toPath(const Poses& poses) {
  nav_msgs::Path path;
  if (poses.empty()) return path;
  path.header = poses.back().header;
  path.poses.assign(poses.begin(), poses.end());
  return path;
}

}  // namespace ardrone_vslam
