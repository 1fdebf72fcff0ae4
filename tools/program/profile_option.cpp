// SPDX-License-Identifier: BSD-3-Clause
#include "program/profile_option.hpp"

#include <algorithm>
#include <stdexcept>

#include "config_files/config_path.hpp"
#include "folders/kitti_folder.hpp"
#include "program/tool_main.hpp"

namespace ardrone_vslam {

OdometryProfile profileOfOption(const std::string& name) {
  const std::string profiles = findConfigFile("odometry_profiles.yaml");
  const auto names = odometryProfileNames(profiles);
  const std::string first = name.substr(0, name.find(','));
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    std::string known;
    for (const auto& other : names) known += (known.empty() ? "" : ", ") + other;
    throw UsageError("--odometry-profile: there is no profile '" + first + "'; known are " + known);
  }
  if (first == name) return loadOdometryProfile(name, profiles);
  try {
    return loadOdometryProfile(name, profiles);
  } catch (const std::runtime_error& e) {
    throw UsageError(std::string("--odometry-profile: ") + e.what());
  }
}

std::string defaultProfile(const std::string& input) {
  return isKittiFolder(input) ? "wheel" : "drone";
}

}  // namespace ardrone_vslam
