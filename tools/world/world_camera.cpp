// SPDX-License-Identifier: BSD-3-Clause
#include "world/world_camera.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sequences/sequence.hpp"
#include "world/block_artefacts.hpp"

namespace ardrone_vslam {
CameraPath pathThrough(const FlightState& state, const Eigen::Isometry3d& T_body_cam) {
  return [state, T_body_cam](double since_stamp_s) {
    const double rate_rad_s = state.angular_rate_body_rad_s.norm();
    const Eigen::Vector3d axis = rate_rad_s > 0
                                     ? Eigen::Vector3d(state.angular_rate_body_rad_s / rate_rad_s)
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
