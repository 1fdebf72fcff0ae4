// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/master.h>

#include <string>

namespace ardrone_vslam {

/// A sentence for users whose raw image topic is silent: most often the camera is not started or
/// the topic has another name, but some drivers and bags have compressed images only.
/// @param published  the master's list of topics that have a publisher
inline std::string adviceWithoutImages(const std::string& image_topic,
                                       const ros::master::V_TopicInfo& published) {
  const std::string compressed = image_topic + "/compressed";
  bool has_raw = false;
  bool has_compressed = false;
  for (const ros::master::TopicInfo& topic : published) {
    has_raw = has_raw || topic.name == image_topic;
    has_compressed = has_compressed || topic.name == compressed;
  }
  if (has_compressed && !has_raw) {
    return "no images on " + image_topic + ", but " + compressed +
           " has a publisher: start with image_transport:=compressed (the parameter "
           "image_transport)";
  }
  return "no images on " + image_topic +
         ": start the camera, or remap `image` to its topic (see `rostopic list`)";
}

}  // namespace ardrone_vslam
