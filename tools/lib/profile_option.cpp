// SPDX-License-Identifier: BSD-3-Clause
#include "profile_option.hpp"

#include <algorithm>
#include <stdexcept>

#include "config_path.hpp"
#include "kitti_folder.hpp"
#include "tool_main.hpp"

namespace ardrone_vslam {

ObserverProfile profileOfOption(const std::string& name) {
  const std::string profiles = findConfigFile("observer_profiles.yaml");
  const auto names = observerProfileNames(profiles);
  const std::string first = name.substr(0, name.find(','));
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    std::string known;
    for (const auto& other : names) known += (known.empty() ? "" : ", ") + other;
    throw UsageError("--observer-profile: there is no profile '" + first + "'; known are " + known);
  }
  if (first == name) return loadObserverProfile(name, profiles);
  try {
    return loadObserverProfile(name, profiles);
  } catch (const std::runtime_error& e) {
    throw UsageError(std::string("--observer-profile: ") + e.what());
  }
}

std::string defaultProfile(const std::string& input) {
  return isKittiFolder(input) ? "wheel" : "drone";
}

}  // namespace ardrone_vslam
