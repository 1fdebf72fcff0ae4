// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace ardrone_vslam {

using Matrix5d = Eigen::Matrix<double, 5, 5>;

/// One track in two images: unit vectors, each in its own image's optical frame.
struct BearingPair {
  Eigen::Vector3d then;  ///< in the earlier image
  Eigen::Vector3d now;   ///< in the later one
};

/// Sigma of a corner between two images [px], per axis.
constexpr double kCornerSigma_px = 0.7;
/// More pairs cost time and say little, as neighbours err alike.
constexpr std::size_t kMostPairs = 120;

/// The camera's way between two images as the odometry says: it tells apart the two motions that
/// move a plane's picture alike, and a turn from a way sideways.
struct DisplacementGuess {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();  ///< axes of the image then
  double sigma_m = 0;                                        ///< per axis
};

/// Turn of the camera, and which way it went, between two images.
struct ImageMotion {
  Eigen::Matrix3d R_then_now =
      Eigen::Matrix3d::Identity();  ///< takes directions in the later image to the earlier one
  Eigen::Vector3d direction_then =
      Eigen::Vector3d::UnitZ();  ///< of length 1, axes of the image then
  /// Inverse covariance [1/rad^2] of the rotation vector, axes of the image then, and of the way
  /// along tangentsOf(direction_then).
  Matrix5d information = Matrix5d::Zero();
  int inliers = 0;  ///< pairs that agree with it
  double cost = 0;  ///< sum over the pairs, each 0 (agrees) to 1; one seen behind the camera 1 more
};

/// Two unit vectors across a direction and each other.
Eigen::Matrix<double, 3, 2> tangentsOf(const Eigen::Vector3d& direction);

/// By how much the camera turned between two images.
struct ImageRotation {
  Eigen::Matrix3d R_then_now =
      Eigen::Matrix3d::Identity();  ///< takes directions in the later image to the earlier one
  /// Inverse covariance of its rotation vector [1/rad^2], axes of the image then. The direction of
  /// the way is fitted, too: a turn that another way explains as well counts little.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  int inliers = 0;  ///< pairs that agree with it
};

/// Fewer tracks tell no turn.
constexpr std::size_t kFewestRotationTracks = 20;

/// As fitRotation(), which says more: turn and way together. The sense of the way is that in which
/// points lie in front of the camera.
std::optional<ImageMotion> fitMotion(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
                                     const DisplacementGuess& guess);

/// A camera's motion between two images as far as it is known without them.
struct KnownMotion {
  Eigen::Matrix3d R_then_now = Eigen::Matrix3d::Identity();
  double rotation_sigma_rad = 0;  ///< per axis
  DisplacementGuess displacement;
};

/// By how many squared deviations the tracks and what is known together are worse explained by one
/// motion than the tracks alone by the one fitted to them. Where a fit has come to rest far from
/// what is known (over a plane a tilt is much like a way sideways) its information claims more.
double squaresAgainst(const KnownMotion& known, const ImageMotion& fitted,
                      const std::vector<BearingPair>& pairs, double corner_sigma_rad);

/// Fits turn and direction of the way to the epipolar planes (5.37) of the tracks, robustly: up to
/// a third of them may be wrong. Neither depths nor the length of the way matter. O(pairs).
/// @param corner_sigma_rad  of a corner between two images, per axis
/// @param guess  how surely the direction is known follows from length and sigma
/// @return nothing for fewer than kFewestRotationTracks pairs, and when too few agree
std::optional<ImageRotation> fitRotation(const std::vector<BearingPair>& pairs,
                                         double corner_sigma_rad, const DisplacementGuess& guess);

}  // namespace ardrone_vslam
