// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam::bench {

/// A feature on the image plane z = 1, and how far a pixel goes on it there.
struct PlanePoint {
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();
  Eigen::Matrix2d plane_per_px = Eigen::Matrix2d::Identity();
};

/// @return nothing where the lens gives no direction
std::optional<PlanePoint> planePointOf(const CameraModel& camera, const Eigen::Vector2d& pixel_px);

/// One point of the world in two images.
struct PointPair {
  PlanePoint first;
  PlanePoint second;
};

/// Of two images, all that their features can tell: where the second camera is from the first only
/// by direction.
struct RelativePose {
  Eigen::Matrix3d R_second_first = Eigen::Matrix3d::Identity();
  Eigen::Vector3d direction_second = Eigen::Vector3d::UnitZ();  ///< of the first camera
  /// What further down in the second image the camera has turned more, per focal length [rad]: a
  /// shutter that rolls while the camera's turn rate changes.
  Eigen::Vector3d rotation_per_row = Eigen::Vector3d::Zero();

  /// @param row_second  y on the second image's plane
  Eigen::Matrix3d essential(double row_second) const;
};

/// How far a pair is from what a relative pose allows, in pixels as seen (distorted).
struct EpipolarDistance {
  double sampson_px = 0;  ///< least common shift of both points, to first order
  double second_px = 0;   ///< of the second point from the line on which it should be
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< of that line, in the second image
};

EpipolarDistance epipolarDistance(const RelativePose& pose, const PointPair& pair);

}  // namespace ardrone_vslam::bench
