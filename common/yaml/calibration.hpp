// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// Reads a calibration as ROS's camera_calibration writes it; only plumb_bob.
/// @throws ConfigError
CameraIntrinsics readCalibration(const std::string& path);

}  // namespace ardrone_vslam
