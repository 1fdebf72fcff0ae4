// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zero_motion/seen_motion.hpp"

namespace ardrone_vslam {

/// How far a corner at rest jumps between two images, per axis: noise, and the corner's own pixel.
constexpr double kCornerJump_px = 0.8;
/// By so many sigmas a turn may differ from the odometry's.
constexpr double kRotationSigmas = 3.5;

/// An image beside the reference.
struct Stillness {
  bool enough_tracks = false;  ///< to tell anything of it
  bool is_still = false;       ///< one turn, within the odometry's, explains how the image moved
  int common = 0;              ///< tracks that both have
  double inlier_share = 0;     ///< of these, those that one turn explains
  double median_px = 0;        ///< of the tracks' motion once the turn is taken out
  Eigen::Matrix3d R_reference_now = Eigen::Matrix3d::Identity();  ///< by the tracks
  /// Covariance of the way that the images may hide, over the scene's depth; axes of the
  /// reference's camera. Largest along the view, and across where a turn may have made up for it.
  Eigen::Matrix3d hidden = Eigen::Matrix3d::Zero();
};

/// The camera's turn since the reference, as the odometry has it.
struct OdometryRotation {
  Eigen::Matrix3d R_reference_now = Eigen::Matrix3d::Identity();
  double sigma_rad = 0;  ///< per axis
};

/// Median of what a turn leaves of the pairs' motion [rad]; 0 without pairs. O(pairs).
double medianLeft_rad(const std::vector<BearingPair>& pairs,
                      const Eigen::Matrix3d& R_reference_now);

/// Finds the turn that most pairs agree on, and whether a shift is left beside it. O(pairs).
/// @param R_guess  of the turn: where the search begins
Stillness stillnessOf(const std::vector<BearingPair>& pairs, const OdometryRotation& odometry,
                      const Eigen::Matrix3d& R_guess, double focal_length_px);

}  // namespace ardrone_vslam
