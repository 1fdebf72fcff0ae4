// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace ardrone_vslam {

/// Minimises by Levenberg-Marquardt with the points eliminated first.
/// @param points  parameters that no residual has two of
/// @param keyframes  how many see them
/// @param step  called after each iteration
/// @throws std::runtime_error when it cannot be solved
void solveBundle(ceres::Problem& problem, const std::vector<double*>& points, std::size_t keyframes,
                 const std::function<void()>& step);

}  // namespace ardrone_vslam
