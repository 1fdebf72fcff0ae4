// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam::reproduction {

/// FAST-s by its definition (3.1), for every s from 9 to 16; the package's own detector knows
/// s = 9..12. No initial test, no order of the pixels: the "original FAST" of table 3.6.
/// @param image  8-bit grey
/// @param threshold  at least 1
/// @return the corners with the largest score of their 3x3 neighbourhood (of equal ones none), as
///   the package's `suppression: strict`, in raster order
std::vector<Corner> arcCorners(const cv::Mat& image, int arc_length_px, int threshold);

/// The same test alone, without scores and suppression. @return the number of corners
int countArcCorners(const cv::Mat& image, int arc_length_px, int threshold);

}  // namespace ardrone_vslam::reproduction
