// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// @param topic  for the messages of errors
/// @throws std::runtime_error naming the topic, the fault and the remedy: lens model that is not
/// plumb_bob, uncalibrated camera (K all zero), binned or cropped images
CameraIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& info,
                                          const std::string& topic);

/// Unrectified camera: R identity, P = [K 0]. The header is left empty.
sensor_msgs::CameraInfo cameraInfoFromIntrinsics(const CameraIntrinsics& camera);

}  // namespace ardrone_vslam
