// SPDX-License-Identifier: BSD-3-Clause
#include "world_camera.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "block_artefacts.hpp"
#include "sequence.hpp"

namespace ardrone_vslam {
namespace {

CameraIntrinsics centredCamera(int width_px, int height_px, double focal_px, double k1, double k2) {
  CameraIntrinsics camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = focal_px;
  camera.cx_px = width_px / 2;
  camera.cy_px = height_px / 2;
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

CameraPath pathThrough(const FlightState& state, const Eigen::Isometry3d& T_body_cam) {
  return [state, T_body_cam](double since_stamp_s) {
    const double rate_rad_s = state.turn_rate_body_rad_s.norm();
    const Eigen::Vector3d axis = rate_rad_s > 0
                                     ? Eigen::Vector3d(state.turn_rate_body_rad_s / rate_rad_s)
                                     : Eigen::Vector3d::UnitX();
    Eigen::Isometry3d T_world_cam =
        state.T_world_body * Eigen::AngleAxisd(rate_rad_s * since_stamp_s, axis) * T_body_cam;
    T_world_cam.translation() +=
        since_stamp_s *
        (state.velocity_world_m_s + 0.5 * since_stamp_s * state.acceleration_world_m_s2);
    return T_world_cam;
  };
}

WorldCamera::WorldCamera(const CameraIntrinsics& camera, const CameraEffects& effects)
    : effects_(effects), renderer_(camera, effects.noise_grey) {}

cv::Mat WorldCamera::shoot(const Scene& scene, const CameraPath& motion, std::uint64_t seed) const {
  const double gain = effects_.gain ? *effects_.gain : gainFor(scene, motion(0));
  cv::Mat image =
      renderer_.render(scene, {motion, effects_.readout_s, effects_.shutter_s, gain}, seed);
  if (effects_.quantiser > 0) addBlockArtefacts(effects_.quantiser, image);
  return image;
}

double WorldCamera::gainFor(const Scene& scene, const Eigen::Isometry3d& T_world_cam) const {
  constexpr double kWantedGrey = 110, kLeast = 0.5, kMost = 8;
  const double mean_grey = std::max(1.0, renderer_.meanGrey(scene, T_world_cam));
  return std::min(std::max(kWantedGrey / mean_grey, kLeast), kMost);
}

}  // namespace ardrone_vslam
