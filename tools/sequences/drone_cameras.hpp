// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

/// The AR.Drone's front camera as its driver's calibration states it: 640x360, 80 degrees across.
CameraIntrinsics arDroneFrontCamera();
/// T_body_cam of that camera: 0.21 m before the middle of the drone.
Eigen::Isometry3d arDroneFrontMount();

/// One of the drone's cameras.
struct CameraChoice {
  std::string name;
  CameraIntrinsics intrinsics;
  Eigen::Isometry3d T_body_cam;
};

/// front; front_wide: the 92 degrees across of its data sheet; bottom: 320x240, 64 degrees across.
const std::vector<CameraChoice>& cameras();
/// @throws std::invalid_argument for an unknown name, listing the known ones
const CameraChoice& cameraNamed(const std::string& name);

}  // namespace ardrone_vslam
