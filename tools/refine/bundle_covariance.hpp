// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <vector>

namespace ardrone_vslam {

/// How well a solved problem knows some of its parameters: the inverse of the normal equations with
/// others eliminated (Triggs et al., 2000), residuals weighed as the loss has it. Takes the cube of
/// the parameters that are not eliminated, and three matrices of their square.
/// @param wanted  parameter blocks, each once
/// @param chain  blocks that hang together with few others of their kind; none of `wanted`
/// @param points  blocks of three parameters that no residual has two of; none of the others
/// @return of the wanted blocks' parameters, in their order
/// @throws std::runtime_error when these have none
Eigen::MatrixXd covarianceOf(ceres::Problem& problem, const std::vector<double*>& wanted,
                             const std::vector<double*>& chain, const std::vector<double*>& points);

}  // namespace ardrone_vslam
