// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// From fewer tracks nothing is told.
constexpr std::size_t kFewestPairs = 15;
/// Jumps of neighbouring corners are alike (compression, interpolation): more tracks say no more.
constexpr double kIndependentTracks = 20;
/// Of so many corners at rest, in sigmas, nearly all jump by less: 99 % in the plane.
constexpr double kInlierSigmas = 3;

/// The camera's way between two images over the scene's typical depth, axes of the image then.
struct SeenMotion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< [1]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();    ///< [1], large along the view
};

/// Fits a way and a small turn to how the tracks shift, robustly. Points may be half the typical
/// depth nearer or further. For ways short beside the depth. O(pairs, of which at most 120 count).
/// @param R_then_now  the camera's turn, known to rotation_sigma_rad per axis
/// @param corner_sigma_rad  of a corner between two images, per axis
/// @return nothing when fewer than two fifths of the pairs agree
std::optional<SeenMotion> seenMotion(const std::vector<BearingPair>& pairs,
                                     const Eigen::Matrix3d& R_then_now, double rotation_sigma_rad,
                                     double corner_sigma_rad);

}  // namespace ardrone_vslam
