// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/driver_topics.hpp"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/image_encodings.h>

#include "bags/messages/bag_messages.hpp"
#include "driver/emulation/driver_video.hpp"

namespace ardrone_vslam {

DriverTopics::DriverTopics(ros::NodeHandle nh, const std::string& tf_prefix, bool unscaled)
    : frames_(driverFrames(tf_prefix)),
      map_frame_(tf_prefix.empty() ? "map" : tf_prefix + "/map"),
      unscaled_(unscaled),
      transport_(nh) {
  for (const std::string name : {"", "front/", "bottom/"}) {
    images_[name] = transport_.advertiseCamera("ardrone/" + name + "image_raw", 10);
  }
  navdata_ = nh.advertise<Navdata>("ardrone/navdata", 200);
  imu_ = nh.advertise<sensor_msgs::Imu>("ardrone/imu", 200);
  mag_ = nh.advertise<geometry_msgs::Vector3Stamped>("ardrone/mag", 200);
  odometry_ = nh.advertise<nav_msgs::Odometry>("ardrone/odometry", 200);
  truth_ = nh.advertise<geometry_msgs::PoseStamped>("truth/pose", 200);
}

void DriverTopics::publish(const DriverMessages& messages) {
  mag_.publish(messages.mag);
  navdata_.publish(messages.navdata);
  imu_.publish(messages.imu);
  odometry_.publish(messages.odometry);
  // The driver sends those of a burst, too. tf keeps the first of a stamp, and each listener prints
  // two lines for every other one, which would drown all warnings.
  if (messages.T_odom_base.header.stamp <= newest_tf_) return;
  newest_tf_ = messages.T_odom_base.header.stamp;
  tf_.sendTransform(messages.T_odom_base);
}

void DriverTopics::publish(const CameraShot& shot) {
  const bool is_bottom = shot.camera == "bottom";
  std_msgs::Header header;
  header.stamp = toRosTime(shot.stamp_ns);
  header.frame_id = is_bottom ? frames_.bottom : frames_.front;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      streamCameraInfo(cameraNamed(shot.camera).intrinsics, unscaled_));
  info->header = header;
  const sensor_msgs::ImagePtr image =
      cv_bridge::CvImage(header, sensor_msgs::image_encodings::RGB8, streamImage(shot.image))
          .toImageMsg();
  for (const std::string name : {"", is_bottom ? "bottom/" : "front/"}) {
    images_[name].publish(image, info);
  }
}

void DriverTopics::publishTruth(const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = toRosTime(stamp_ns);
  message.header.frame_id = map_frame_;
  message.pose = toPose(T_map_base);
  truth_.publish(message);
}

void DriverTopics::sendTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  for (const auto& transform : transforms) tf_.sendTransform(transform);
}

bool DriverTopics::isWatched() const {
  for (const auto& [name, publisher] : images_) {
    if (publisher.getNumSubscribers() > 0) return true;
  }
  return false;
}

}  // namespace ardrone_vslam
