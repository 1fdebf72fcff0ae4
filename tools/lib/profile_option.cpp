// SPDX-License-Identifier: BSD-3-Clause
#include "profile_option.hpp"

#include <algorithm>

#include "config_path.hpp"
#include "kitti_folder.hpp"
#include "tool_main.hpp"

namespace ardrone_vslam {

ObserverProfile profileOfOption(const std::string& name) {
  const std::string profiles = findConfigFile("observer_profiles.yaml");
  const auto names = observerProfileNames(profiles);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const auto& other : names) known += (known.empty() ? "" : ", ") + other;
    throw UsageError("--observer-profile: there is no profile '" + name + "'; known are " + known);
  }
  return loadObserverProfile(name, profiles);
}

std::string defaultProfile(const std::string& input) {
  return isKittiFolder(input) ? "wheel" : "drone";
}

}  // namespace ardrone_vslam
