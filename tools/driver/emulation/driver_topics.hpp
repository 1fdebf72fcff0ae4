// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "driver/emulation/driver_emulation.hpp"
#include "world/live_camera.hpp"

namespace ardrone_vslam {

/// What the driver publishes: its topics below ardrone/, tf, and besides the truth.
class DriverTopics {
 public:
  /// @param tf_prefix  without slashes around it; may be empty
  /// @param unscaled  of streamCameraInfo
  DriverTopics(ros::NodeHandle nh, const std::string& tf_prefix, bool unscaled);

  void publish(const DriverMessages& messages);
  /// The image under both of its names, with camera_info.
  void publish(const CameraShot& shot);
  /// truth/pose
  void publishTruth(const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns);
  void sendTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms);

  /// Whether anybody takes images.
  bool isWatched() const;

 private:
  DriverFrames frames_;
  std::string map_frame_;
  bool unscaled_;
  image_transport::ImageTransport transport_;
  std::map<std::string, image_transport::CameraPublisher> images_;  // by name in /ardrone
  ros::Publisher navdata_, imu_, mag_, odometry_, truth_;
  tf2_ros::TransformBroadcaster tf_;
  ros::Time newest_tf_;  // of T_odom_base
};

}  // namespace ardrone_vslam
