// SPDX-License-Identifier: BSD-3-Clause
#include "bags/messages/grey_image.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "input_checks/decode_image.hpp"

namespace ardrone_vslam {
namespace {

namespace enc = sensor_msgs::image_encodings;

const std::vector<std::string>& encodings() {
  static const std::vector<std::string> kEncodings{
      enc::MONO8, enc::TYPE_8UC1,   enc::MONO16,      enc::RGB8,        enc::BGR8,       enc::RGBA8,
      enc::BGRA8, enc::BAYER_RGGB8, enc::BAYER_BGGR8, enc::BAYER_GBRG8, enc::BAYER_GRBG8};
  return kEncodings;
}

}  // namespace

bool isSupportedEncoding(const std::string& encoding) {
  return std::find(encodings().begin(), encodings().end(), encoding) != encodings().end();
}

std::string supportedEncodings() {
  std::string list;
  for (const auto& encoding : encodings()) list += (list.empty() ? "" : ", ") + encoding;
  return list;
}

bool isWhole(const sensor_msgs::Image& message) {
  const auto pixel_bits = static_cast<std::uint64_t>(enc::numChannels(message.encoding)) *
                          static_cast<std::uint64_t>(enc::bitDepth(message.encoding));
  return message.width > 0 && message.height > 0 &&
         message.step >= pixel_bits / 8 * message.width &&
         message.data.size() == std::uint64_t{message.step} * message.height;
}

cv::Mat greyImage(const sensor_msgs::Image& message) {
  if (message.encoding == enc::MONO8 || message.encoding == enc::TYPE_8UC1) {
    // cv_bridge knows no way from 8UC1 (no colour format) to mono8.
    const cv::Mat view(static_cast<int>(message.height), static_cast<int>(message.width), CV_8UC1,
                       const_cast<std::uint8_t*>(message.data.data()), message.step);
    return view.clone();
  }
  return cv_bridge::toCvCopy(message, enc::MONO8)->image;
}

cv::Mat greyImage(const sensor_msgs::CompressedImage& message) {
  return decodeGrey(message.data);
}

}  // namespace ardrone_vslam
