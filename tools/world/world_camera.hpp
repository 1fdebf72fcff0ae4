// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"
#include "world/flight/world_flight.hpp"
#include "world/render/world_renderer.hpp"

namespace ardrone_vslam {

/// The camera of a drone that goes on as it does in this state, for the milliseconds of an image.
CameraPath pathThrough(const FlightState& state, const Eigen::Isometry3d& T_body_cam);

/// What lies between the light and the image.
struct CameraEffects {
  double shutter_s = 0;              ///< how long each row is exposed: motion blur
  double readout_s = 0;              ///< from the first row to the last one: rolling shutter
  std::optional<double> gain = 1.0;  ///< of light and noise alike; nothing: automatic
  double noise_grey = 2;             ///< sigma of the white noise at gain 1
  int quantiser = 0;                 ///< of block artefacts, as H.264's QP, 1 .. 51; 0: none
};

constexpr int kLargestQuantiser = 51;

/// Takes pictures of a world, frame by frame, in any order.
class WorldCamera {
 public:
  /// @throws std::invalid_argument when the lens folds back inside the image
  WorldCamera(const CameraIntrinsics& camera, const CameraEffects& effects);

  /// The picture with this stamp, 8-bit grey. @param motion  the camera about that time, over half
  /// of shutter and readout before and after; @param seed  of the noise
  cv::Mat shoot(const Scene& scene, const CameraPath& motion, std::uint64_t seed) const;

 private:
  double gainFor(const Scene& scene, const Eigen::Isometry3d& T_world_cam) const;

  CameraEffects effects_;
  WorldRenderer renderer_;
};

}  // namespace ardrone_vslam
