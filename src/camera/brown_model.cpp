// SPDX-License-Identifier: BSD-3-Clause
#include "camera/brown_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardrone_vslam {

double findFoldRadius(const CameraIntrinsics& c) {
  constexpr double kStep = 1e-3;
  for (double low = 0; low < kWidestRadius; low += kStep) {
    double high = low + kStep;
    if (radialSlope(c, high * high) > 0) continue;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (radialSlope(c, middle * middle) > 0 ? low : high) = middle;
    }
    return low;
  }
  return std::numeric_limits<double>::infinity();
}

double undistortedRadius(const CameraIntrinsics& c, double r_distorted, double widest) {
  constexpr double kTolerance = 1e-12;
  constexpr int kSteps = 100;
  double low = 0;
  double high = widest;
  double r = std::min(r_distorted, high);
  double last_error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    const double error = r * radialFactor(c, r * r) - r_distorted;
    if (std::abs(error) < kTolerance) break;
    (error > 0 ? high : low) = r;
    const double newton = r - error / radialSlope(c, r * r);
    // Newton's steps may go to and fro between the same two radii for ever.
    const bool converges = std::abs(error) < 0.5 * last_error && newton > low && newton < high;
    r = converges ? newton : 0.5 * (low + high);
    last_error = std::abs(error);
  }
  return r;
}

}  // namespace ardrone_vslam
