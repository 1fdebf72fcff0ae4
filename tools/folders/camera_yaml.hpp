// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// Reads a calibration as ROS's camera_calibration writes it. distortion_model must be plumb_bob
/// with five coefficients (or four, or none) and square pixels need not hold.
/// Not ROS's camera_calibration_parsers: the tools are built without ROS, too, and it neither
/// refuses a lens that cannot be nor says which key is wrong.
/// @throws std::runtime_error naming the file, the key and the remedy; other lens models by name
CameraIntrinsics readCameraYaml(const std::string& path);

}  // namespace ardrone_vslam
