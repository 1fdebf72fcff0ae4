// SPDX-License-Identifier: BSD-3-Clause
#include "images/image_input.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include "input_checks/decode_image.hpp"

namespace ardrone_vslam {
namespace {

GreyImage refused(const std::string& fault) {
  GreyImage image;
  image.fault = fault;
  return image;
}

}  // namespace

GreyImage toGrey(const sensor_msgs::ImageConstPtr& message) {
  if (message->width == 0 || message->height == 0 || message->data.empty()) {
    return refused("the image is empty; check the camera driver");
  }
  namespace enc = sensor_msgs::image_encodings;
  // cv_bridge knows no way from 8UC1 (no colour format) to mono8; the bytes are the same.
  const bool is_grey = message->encoding == enc::TYPE_8UC1;
  try {
    const auto shared = cv_bridge::toCvShare(message, is_grey ? enc::TYPE_8UC1 : enc::MONO8);
    GreyImage image;
    image.pixels = shared->image;
    image.owner = shared;
    return image;
  } catch (const std::exception& e) {  // cv_bridge::Exception and, for odd depths, cv::Exception
    return refused("encoding '" + message->encoding + "', " + std::to_string(message->width) + "x" +
                   std::to_string(message->height) + ", cannot be read (" + e.what() +
                   "); publish mono8, rgb8, bgr8 or a bayer encoding with matching step and data");
  }
}

GreyImage toGrey(const sensor_msgs::CompressedImageConstPtr& message) {
  std::string fault = isCutOff(message->data) ? " (cut off before its end)" : "";
  try {
    GreyImage image;
    image.pixels = decodeGrey(message->data);
    if (!image.pixels.empty()) return image;
  } catch (const cv::Exception& e) {
    fault = std::string(" (") + e.what() + ")";
  }
  return refused("compressed image of format '" + message->format + "', " +
                 std::to_string(message->data.size()) + " bytes, cannot be decoded" + fault +
                 "; publish jpeg or png");
}

}  // namespace ardrone_vslam
