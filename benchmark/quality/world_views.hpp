// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "ardrone_vslam/camera_model.hpp"
#include "match_metrics.hpp"
#include "world/render/world_renderer.hpp"

namespace ardrone_vslam::quality {

/// T_world_cam of a level camera that looks along the horizontal direction of this angle.
/// @param yaw_rad  from the world's x axis, to the left
Eigen::Isometry3d lookAlong(double yaw_rad, const Eigen::Vector3d& position_m);

/// Where the ray of a pixel first meets a surface of the scene [m, world]; nothing where it meets
/// none or the lens has no such ray.
std::optional<Eigen::Vector3d> pointSeen(const Scene& scene, const CameraModel& camera,
                                         const Eigen::Isometry3d& T_world_cam,
                                         const Eigen::Vector2d& pixel_px);

/// Pixel of what another camera pose sees at a pixel; nothing where something hides it.
std::optional<Eigen::Vector2d> transferPixel(const Scene& scene, const CameraModel& camera,
                                             const Eigen::Isometry3d& T_world_from,
                                             const Eigen::Isometry3d& T_world_to,
                                             const Eigen::Vector2d& pixel_px);

/// The synthetic room as one camera sees it from anywhere, with the truth of which pixels show the
/// same.
class WorldViews {
 public:
  explicit WorldViews(const CameraIntrinsics& camera);

  cv::Mat render(const Eigen::Isometry3d& T_world_cam, std::uint64_t noise_seed) const;
  /// Refers to this object.
  PairGeometry geometry(const Eigen::Isometry3d& T_world_a,
                        const Eigen::Isometry3d& T_world_b) const;

 private:
  Scene scene_;
  CameraModel camera_;
  WorldRenderer renderer_;
};

}  // namespace ardrone_vslam::quality
