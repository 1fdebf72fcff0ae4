// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <map>
#include <string>

#include "bags/bag_sequence.hpp"

namespace ardrone_vslam {

/// Topic -> type, of all connections of the bag.
using TopicTypes = std::map<std::string, std::string>;
TopicTypes topicTypes(const rosbag::Bag& bag);

/// The topics that are read; empty: there is none.
struct ChosenTopics {
  std::string image;
  bool is_compressed = false;
  std::string camera_info;
  std::string odometry;
  std::string navdata;
  std::string imu;
  std::string command;
  std::string truth;
  std::string range;
};

/// The named topics, the others by type.
/// @throws std::runtime_error when a named topic is missing or of another type, when there are no
/// images or no camera_info, or when several fit; it lists the topics that are there
ChosenTopics chooseTopics(const std::string& path, const TopicTypes& types,
                          const BagReadOptions& options);

}  // namespace ardrone_vslam
