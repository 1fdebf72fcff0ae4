// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lens_methods.hpp"

namespace ardrone_vslam::bench {

struct LensErrors {
  double mean_px = 0;
  double largest_px = 0;
  int refused = 0;  ///< pixels that have no direction
};

/// Of every pixel, row by row, on the plane of the undistorted image, against Newton's method; NaN
/// where there is no direction.
std::vector<double> errors_px(const CameraIntrinsics& camera, const LensMethod& method);

LensErrors summaryOf(const std::vector<double>& errors_px);

constexpr int kLensRounds = 301;
constexpr std::size_t kTimedPixels = 600;  ///< of a frame

/// Of one pixel: medians of rounds in which the methods take turns, kTimedPixels each [ns].
std::vector<double> times_ns(const CameraIntrinsics& camera, const std::vector<LensMethod>& methods,
                             int rounds = kLensRounds);

}  // namespace ardrone_vslam::bench
