// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>
#include <string>

#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam {

/// An 8-bit grey image, or what is wrong with the message and what helps.
struct GreyImage {
  cv::Mat pixels;                       ///< empty exactly when there is a fault
  boost::shared_ptr<const void> owner;  ///< keeps pixels alive that are the message's own
  std::string fault;

  ImageView view() const {
    return {pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step)};
  }
};

/// Every encoding that cv_bridge turns into mono8 (mono, rgb, bgr, with alpha, bayer, 16 bits).
/// mono8 is not copied.
GreyImage toGrey(const sensor_msgs::ImageConstPtr& message);

/// JPEG, PNG or whatever else OpenCV decodes.
GreyImage toGrey(const sensor_msgs::CompressedImageConstPtr& message);

/// An image message of either kind: exactly one pointer is set.
struct AnyImage {
  sensor_msgs::ImageConstPtr raw;
  sensor_msgs::CompressedImageConstPtr compressed;

  const std_msgs::Header& header() const { return raw ? raw->header : compressed->header; }
};

inline GreyImage toGrey(const AnyImage& image) {
  return image.raw ? toGrey(image.raw) : toGrey(image.compressed);
}

}  // namespace ardrone_vslam
