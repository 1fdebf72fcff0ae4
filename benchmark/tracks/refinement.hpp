// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "epipolar.hpp"

namespace ardrone_vslam::bench {

/// The relative pose near `start` that fits the pairs best: robust Gauss-Newton steps on their
/// Sampson distances.
/// @return nothing where there are so few pairs that the fit would hide what they err
std::optional<RelativePose> refined(const RelativePose& start, const std::vector<PointPair>& pairs);

}  // namespace ardrone_vslam::bench
