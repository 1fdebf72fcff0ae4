// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/camera_model.hpp"

namespace ardrone_vslam {

constexpr double kWidestRadius =
    10.0;  // on the plane z = 1: 84 degrees off the axis, wider than Brown's model serves

/// Brown's radial factor 1 + k1 r^2 + k2 r^4 + k3 r^6 (5.3).
inline double radialFactor(const CameraIntrinsics& c, double r2) {
  return 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
}

/// Its derivative with respect to r^2.
inline double radialFactorSlope(const CameraIntrinsics& c, double r2) {
  return c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3);
}

/// Derivative of r * radialFactor with respect to r: zero at the fold.
inline double radialSlope(const CameraIntrinsics& c, double r2) {
  return 1 + r2 * (3 * c.k1 + r2 * (5 * c.k2 + r2 * 7 * c.k3));
}

/// Undistorted radius beyond which the radial model is no longer monotonic; infinity if it never
/// folds within kWidestRadius.
double findFoldRadius(const CameraIntrinsics& c);

/// The radius that the radial model maps to `r_distorted`, to 1e-12; Newton's method inside the
/// bracket, so that it cannot cross the fold.
/// @param widest  of undistorted radii; the model is monotonic up to there and reaches r_distorted
double undistortedRadius(const CameraIntrinsics& c, double r_distorted, double widest);

}  // namespace ardrone_vslam
