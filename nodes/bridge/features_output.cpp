// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/features_output.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <utility>

#include "conversions/conversions.hpp"
#include "conversions/onboard_conversion.hpp"
#include "outputs/debug_image.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kFeaturesQueue = 100;

}  // namespace

FeaturesOutput::FeaturesOutput(ros::NodeHandle nh, const CameraIntrinsics& camera,
                               std::string camera_frame)
    : camera_(camera),
      camera_frame_(std::move(camera_frame)),
      features_pub_(nh.advertise<Features>("features", kFeaturesQueue)),
      debug_pub_(image_transport::ImageTransport(nh).advertise("debug_image", 1)) {}

void FeaturesOutput::publish(ImageFeatures features) {
  outside_ += addBearings(camera_, features);
  Features message;
  toMessage(features, camera_frame_, message);
  features_pub_.publish(message);
  if (debug_pub_.getNumSubscribers() == 0) return;
  const cv::Mat black = cv::Mat::zeros(features.height_px, features.width_px, CV_8UC1);
  debug_pub_.publish(cv_bridge::CvImage(message.header, sensor_msgs::image_encodings::BGR8,
                                        drawFeatures(black, features))
                         .toImageMsg());
}

}  // namespace ardrone_vslam
