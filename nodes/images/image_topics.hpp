// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/master.h>

#include <algorithm>
#include <string>

namespace ardrone_vslam {

/// A sentence for users whose image topic is silent: most often the camera is not started or the
/// topic has another name, but some drivers and bags have compressed images only, others raw ones,
/// and the AR.Drone's driver has topics of both cameras, of which one streams.
/// @param published  the master's list of topics that have a publisher
inline std::string adviceWithoutImages(const std::string& image_topic,
                                       const ros::master::V_TopicInfo& published) {
  const auto isPublished = [&published](const std::string& name) {
    return std::any_of(published.begin(), published.end(),
                       [&name](const ros::master::TopicInfo& topic) { return topic.name == name; });
  };
  const std::string tail = "/compressed";
  const bool is_compressed =
      image_topic.size() > tail.size() &&
      image_topic.compare(image_topic.size() - tail.size(), tail.size(), tail) == 0;
  const std::string other =
      is_compressed ? image_topic.substr(0, image_topic.size() - tail.size()) : image_topic + tail;
  const std::string silent = "no images on " + image_topic;
  if (isPublished(image_topic)) {
    return silent +
           ", although it has a publisher: start the camera; of an AR.Drone's two only one streams "
           "(`rosservice call /ardrone/togglecam` changes to the other)";
  }
  if (isPublished(other)) {
    return silent + ", but " + other + " has a publisher: start with image_transport:=" +
           (is_compressed ? "raw" : "compressed") + " (the parameter image_transport)";
  }
  return silent +
         ": start the camera, or remap `image` to its topic (launch files: camera:=NAMESPACE "
         "image:=NAME; see `rostopic list`)";
}

}  // namespace ardrone_vslam
