// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

constexpr int kStreamWidth_px = 640;
constexpr int kStreamHeight_px = 360;

/// An image of the drone's camera as the driver publishes it: rgb8, 640x360. The bottom camera's
/// 320x240 is doubled and loses a quarter of its height, half above and half below.
cv::Mat streamImage(const cv::Mat& grey);
/// Of that stream. @pre camera is 640x360 or half as wide
CameraIntrinsics streamCalibration(const CameraIntrinsics& camera);

/// camera_info of the stream. @param unscaled  with width and height of the stream and all else as
/// calibrated at another size: the bottom camera's own 320x240, the front camera's 1280x720
sensor_msgs::CameraInfo streamCameraInfo(const CameraIntrinsics& camera, bool unscaled);

}  // namespace ardrone_vslam
