// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/image_rotation.hpp"

namespace ardrone_vslam {

/// Weight of what is left of a residual, after Geman and McClure.
inline double weightOf(double left, double scale) {
  const double off = left / scale;
  return 1 / ((1 + off * off) * (1 + off * off));
}

/// As if all points were equally far away: a turn, and a shift along the way, that most tracks
/// agree on. What the shift leaves is parallax, so the weights are as wide as the mean of it.
/// @param least_scale_rad  what is left within this counts
/// @return R_then_now
Eigen::Matrix3d commonRotation(const std::vector<BearingPair>& pairs, double least_scale_rad,
                               const Eigen::Vector3d& direction_then);

}  // namespace ardrone_vslam
