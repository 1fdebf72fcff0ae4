// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bag_damage.hpp"
#include "bags/bag_topics.hpp"
#include "bags/messages/bag_messages.hpp"
#include "driver/emulation/driver_bag.hpp"
#include "support/read_file.hpp"
#include "support/sequence_folders.hpp"
#include "support/shipped_profiles.hpp"

namespace ardrone_vslam {

inline Eigen::Vector3d positionOf(const geometry_msgs::Pose& pose) {
  return {pose.position.x, pose.position.y, pose.position.z};
}
inline Eigen::Quaterniond rotationOf(const geometry_msgs::Pose& pose) {
  return {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z};
}
inline Eigen::Vector3d velocityOf(const nav_msgs::Odometry& odometry) {
  const auto& v = odometry.twist.twist.linear;
  return {v.x, v.y, v.z};
}

/// A driver's bag of a second and a half of `laps` with four images a second.
class DriverRecording {
 public:
  explicit DriverRecording(const DriverFaults& faults, const std::string& profile = "drone",
                           const std::string& camera = "front", const std::string& tf_prefix = "") {
    DriverBagOptions options;
    options.faults = faults;
    options.tf_prefix = tf_prefix;
    options.camera = camera;
    options.profile = test::shippedProfile(profile);
    options.tool = "test";
    writeDriverBag(world(), options, path());
    bag_.open(path(), rosbag::bagmode::Read);
  }

  std::string path() const { return folder_.file("driver.bag"); }
  std::map<std::string, std::string> types() const { return topicTypes(bag_); }
  std::string bytes() const { return test::readFile(path()); }

  template <class Message>
  std::vector<Message> read(const std::string& topic) const {
    std::vector<Message> messages;
    for (const auto& instance : rosbag::View(bag_, rosbag::TopicQuery(topic))) {
      messages.push_back(*instance.instantiate<Message>());
    }
    return messages;
  }
  std::vector<nav_msgs::Odometry> odometry() const {
    return read<nav_msgs::Odometry>("/ardrone/odometry");
  }

  /// Of the messages of a topic, all of which begin with a header: sequence number, then stamp.
  std::vector<std::int64_t> stamps_ns(const std::string& topic) const {
    std::vector<std::int64_t> stamps_ns;
    for (const std::string& message : raw(topic)) {
      std::uint32_t sec = 0, nsec = 0;
      message.copy(reinterpret_cast<char*>(&sec), sizeof(sec), 4);
      message.copy(reinterpret_cast<char*>(&nsec), sizeof(nsec), 8);
      stamps_ns.push_back(std::int64_t{sec} * 1'000'000'000 + nsec);
    }
    return stamps_ns;
  }
  bool isRecordedAtItsStamps() const {
    for (const auto& type : types()) {
      if (type.first.rfind("/ardrone/", 0) != 0) continue;
      const auto stamps = stamps_ns(type.first);
      std::size_t i = 0;
      for (const auto& instance : rosbag::View(bag_, rosbag::TopicQuery(type.first))) {
        if (toNanoseconds(instance.getTime()) != stamps[i++]) return false;
      }
    }
    return true;
  }

  /// The messages as they were sent.
  std::vector<std::string> raw(const std::string& topic) const {
    std::vector<std::string> messages;
    for (const auto& instance : rosbag::View(bag_, rosbag::TopicQuery(topic))) {
      std::string bytes(instance.size(), '\0');
      ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                         static_cast<std::uint32_t>(bytes.size()));
      instance.write(stream);
      messages.push_back(bytes);
    }
    return messages;
  }

 private:
  /// Painted once.
  static const WorldSequence& world() {
    static const WorldSequence sequence = [] {
      WorldOptions options;
      options.duration_s = 1.5;
      options.rate_hz = 4;
      return WorldSequence(options);
    }();
    return sequence;
  }
  TemporaryFolder folder_;
  rosbag::Bag bag_;
};

}  // namespace ardrone_vslam
