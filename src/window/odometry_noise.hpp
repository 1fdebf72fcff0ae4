// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"
#include "linear/covariance_matrix.hpp"

namespace ardrone_vslam {

/// Growth of the position's variance between two states, per axis, by white noise of the odometry:
/// what it says itself, else as configured.
/// @param displacement_m  between the two
/// @param travelled_m  since the odometry began, up to the first of them
double walkVariance_m2(const OdometryNoiseConfig& config, const OdometryState& from,
                       const OdometryState& to, double displacement_m, double travelled_m);

/// What is known of a run's first frame: the covariance of a window of this frame alone.
/// @param P  zero on entry
void setStart(const OdometryNoiseConfig& config, const Eigen::Matrix3d& R_odom_base,
              CovarianceMatrix::View P);

}  // namespace ardrone_vslam
