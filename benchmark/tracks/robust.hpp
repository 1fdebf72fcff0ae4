// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace ardrone_vslam::bench {

/// The upper one of two in the middle; NaN of none.
double medianOf(std::vector<double> values);

/// Standard deviation about 0 of what is normally distributed, by the median of the magnitudes: a
/// few wrong values do not count. NaN of none.
double sigmaOf(std::vector<double> values);

}  // namespace ardrone_vslam::bench
