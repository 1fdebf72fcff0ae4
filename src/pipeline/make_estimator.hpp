// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "ardrone_vslam/slam_config.hpp"
#include "estimator/estimator.hpp"

namespace ardrone_vslam {

/// The one that the configuration names.
std::unique_ptr<Estimator> makeEstimator(const SlamConfig& config,
                                         const Eigen::Isometry3d& T_base_cam);

}  // namespace ardrone_vslam
