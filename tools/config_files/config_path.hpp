// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Path of a file of config/ (for example "odometry_profiles.yaml"), looked for in the installed
/// package beside the running program, then in the source folder that it was built from.
/// @throws std::runtime_error naming the file and the places
std::string findConfigFile(const std::string& name);

}  // namespace ardrone_vslam
