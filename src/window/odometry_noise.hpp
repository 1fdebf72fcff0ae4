// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/odometry_config.hpp"

namespace ardrone_vslam {

/// Growth of the position's variance between two states, per axis, by white noise of the odometry:
/// what it says itself, else as configured.
/// @param displacement_m  between the two
/// @param way_m  since the odometry began, up to the first of them
double walkVariance_m2(const OdometryNoiseConfig& config, const OdometryState& from,
                       const OdometryState& to, double displacement_m, double way_m);

}  // namespace ardrone_vslam
