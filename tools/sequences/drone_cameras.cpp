// SPDX-License-Identifier: BSD-3-Clause
#include "sequences/drone_cameras.hpp"

#include <stdexcept>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {
namespace {

CameraIntrinsics centredCamera(int width_px, int height_px, double focal_px, double k1, double k2) {
  CameraIntrinsics camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = focal_px;
  camera.cx_px = width_px / 2.0;
  camera.cy_px = height_px / 2.0;
  camera.k1 = k1;
  camera.k2 = k2;
  return camera;
}

/// As its driver broadcasts it: RPY (180, 0, 90) degrees, the image's right on the drone's left.
Eigen::Isometry3d arDroneBottomMount() {
  Eigen::Isometry3d T_body_cam = Eigen::Isometry3d::Identity();
  T_body_cam.linear() << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  T_body_cam.translation() << 0, -0.02, 0;
  return T_body_cam;
}

}  // namespace

CameraIntrinsics arDroneFrontCamera() {
  return centredCamera(640, 360, 570, -0.525, 0.274);
}

Eigen::Isometry3d arDroneFrontMount() {
  return Eigen::Translation3d(0.21, 0, 0) * forwardCamera();
}

const std::vector<CameraChoice>& cameras() {
  static const std::vector<CameraChoice> all = {
      {"front", arDroneFrontCamera(), arDroneFrontMount()},
      // k2 is large enough that the model never folds back.
      {"front_wide", centredCamera(640, 360, 470.5, -0.53, 0.28), arDroneFrontMount()},
      {"bottom", centredCamera(320, 240, 316.8, 0.12, -0.24), arDroneBottomMount()},
  };
  return all;
}

const CameraChoice& cameraNamed(const std::string& name) {
  std::string known;
  for (const auto& camera : cameras()) {
    if (camera.name == name) return camera;
    known += (known.empty() ? "" : ", ") + camera.name;
  }
  throw std::invalid_argument("there is no camera '" + name + "'; known are " + known);
}

}  // namespace ardrone_vslam
