// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "simulation/odometry_model.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam::test {

constexpr double kRadPerDeg = M_PI / 180;  // profiles are in degrees

/// The file of the odometry profiles that the package ships.
inline const std::string kShippedProfiles = test::packageFile("config/odometry_profiles.yaml");

/// The profile of that name among them.
inline OdometryProfile shippedProfile(const std::string& name) {
  return loadOdometryProfile(name, kShippedProfiles);
}

}  // namespace ardrone_vslam::test
