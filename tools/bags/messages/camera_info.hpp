// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "ardrone_vslam/camera_model.hpp"
#include "with_ros/camera_info_conversion.hpp"

namespace ardrone_vslam {

/// What the tracker makes of the same message (toIntrinsics).
/// @param topic  for the messages of errors
/// @throws std::runtime_error naming the topic, the fault and the remedy
CameraIntrinsics intrinsicsFromCameraInfo(const sensor_msgs::CameraInfo& info,
                                          const std::string& topic, const CameraInfoUse& use = {});

/// Unrectified camera: R identity, P = [K 0]. The header is left empty.
sensor_msgs::CameraInfo cameraInfoFromIntrinsics(const CameraIntrinsics& camera);

}  // namespace ardrone_vslam
