// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam::test {

/// Without distortion, the principal point in the middle.
inline CameraIntrinsics pinhole(int width_px, int height_px, double focal_px) {
  CameraIntrinsics camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = focal_px;
  camera.cx_px = 0.5 * width_px;
  camera.cy_px = 0.5 * height_px;
  return camera;
}

}  // namespace ardrone_vslam::test
