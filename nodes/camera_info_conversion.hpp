// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "ardrone_vslam/camera_model.hpp"
#include "checked.hpp"

namespace ardrone_vslam {

/// For the tracker and for the tools that read bags, so that both judge a calibration alike.
/// Distortion models: plumb_bob, none (empty model and coefficients), and rational_polynomial whose
/// denominator is zero; every other is refused by name, and so are binned and cropped images.
/// @param rectified  the images are rectified: takes P without distortion instead of K and D
Checked<CameraIntrinsics> toIntrinsics(const sensor_msgs::CameraInfo& info, bool rectified);

}  // namespace ardrone_vslam
