// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>
#include <string>

namespace ardrone_vslam {

/// Whether mono8, 8UC1, rgb8, bgr8, rgba8, bgra8 or an 8-bit Bayer pattern.
bool isSupportedEncoding(const std::string& encoding);
/// The supported encodings, for messages.
std::string supportedEncodings();

/// Whether step, height and the number of bytes belong together.
bool isWhole(const sensor_msgs::Image& message);

/// 8-bit grey copy. @pre supported encoding, whole message
cv::Mat greyImage(const sensor_msgs::Image& message);
/// 8-bit grey; empty when the data (png, jpeg) cannot be decoded or is cut off.
cv::Mat greyImage(const sensor_msgs::CompressedImage& message);

}  // namespace ardrone_vslam
