// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <string>

#include "ardrone_vslam/camera_model.hpp"
#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// The drone's features on the tracker's topics: `features`, and `debug_image` without the image.
class FeaturesOutput {
 public:
  /// @param camera  by which pixels become bearings
  FeaturesOutput(ros::NodeHandle nh, const CameraIntrinsics& camera, std::string camera_frame);

  /// @param features  without bearings
  void publish(ImageFeatures features);
  /// Features that were not in the calibration's image.
  std::uint64_t outside() const { return outside_; }

 private:
  CameraModel camera_;
  std::string camera_frame_;
  ros::Publisher features_pub_;
  image_transport::Publisher debug_pub_;
  std::uint64_t outside_ = 0;
};

}  // namespace ardrone_vslam
