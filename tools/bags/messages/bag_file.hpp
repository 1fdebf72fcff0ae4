// SPDX-License-Identifier: BSD-3-Clause
// What all writers of bags share.
#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/Header.h>

#include <functional>
#include <opencv2/core.hpp>
#include <string>

namespace ardrone_vslam {

enum class BagCompression { kNone, kLz4, kBz2 };  ///< of a bag's chunks

/// Lets `write` fill a new bag and gives it its name when it is whole: when it fails nothing is
/// left behind and an existing file stays. @throws std::runtime_error naming file and remedy; what
/// `write` throws
void writeBagFile(const std::string& path, BagCompression compression,
                  const std::function<void(rosbag::Bag&)>& write);

/// As image_transport's publishers make it. @param image  8-bit grey or RGB, as the header's
/// encoding mono8 or rgb8
sensor_msgs::CompressedImage compressedImage(const std_msgs::Header& header, const cv::Mat& image,
                                             bool is_png);

/// rosbag play latches what was recorded from a latched publisher.
template <class Message>
boost::shared_ptr<ros::M_string> latchedHeader(const Message& message) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  (*header)["callerid"] = "/make_bag";
  (*header)["latching"] = "1";
  return header;
}

}  // namespace ardrone_vslam
