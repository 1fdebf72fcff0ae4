// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ardrone_vslam/landmark.hpp"

namespace ardrone_vslam {

/// A point by two rays, and how well they fix it.
struct TriangulatedPoint {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();  ///< on the present ray, put on the plane
  double depth_m = 0;                                      ///< along the present ray (5.15)
  double parallax_rad = 0;  ///< angle between the rays within the epipolar plane (5.13)
};

/// Point seen first along `first` and now along `present` by epipolar geometry (5.12-5.18), with
/// signed angles: rays that diverge have no point. The present ray is projected on the epipolar
/// plane first.
/// @return nothing for coincident positions, motion along the first ray, or a point behind either
/// camera
std::optional<TriangulatedPoint> triangulate(const Ray& first, const Ray& present);

/// Where the present ray lies relative to the epipolar plane of the first one.
struct EpipolarOffset {
  double across =
      0;  ///< sine of the angle between ray and plane, >= 0 (5.37-5.44 as one plane test)
  double along = 0;  ///< signed sine of the parallax within the plane; negative: the rays diverge,
                     ///< no point in front
  double ahead = 0;  ///< signed sine of the angle from the motion to the present ray within the
                     ///< plane; negative: rays that converge do so behind the first camera
};

/// @return nothing where the plane does not exist (coincident positions, motion along the first
/// ray)
std::optional<EpipolarOffset> epipolarOffset(const Ray& first, const Ray& present);

/// Sigma of a landmark or of its measurement, across the ray (5.19, 5.22): sigma_p + d sigma_a.
inline double measurementSigma_m(double position_sigma_m, double depth_m, double angle_sigma_rad) {
  return position_sigma_m + depth_m * angle_sigma_rad;
}

/// Sigma along the ray, which (5.19) leaves out: the sigma across it over the sine of the
/// parallax.
double depthSigma_m(double sigma_m, double parallax_rad);

}  // namespace ardrone_vslam
