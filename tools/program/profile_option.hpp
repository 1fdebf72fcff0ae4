// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {

/// The profile that --odometry-profile names, of config/odometry_profiles.yaml.
/// @throws UsageError when there is none of this name; std::runtime_error as loadOdometryProfile
OdometryProfile profileOfOption(const std::string& name);

/// Which odometry to simulate when none is named: wheel on KITTI's car, else drone.
/// @param input  folder or file of images
std::string defaultProfile(const std::string& input);

}  // namespace ardrone_vslam
