// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <stdexcept>

#include "observer_model.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRadPerDeg = M_PI / 180;

struct Key {
  const char* name;
  double ObserverProfile::*field;
  double si_per_unit;
  bool zero_allowed;
};

/// Numbers of a profile as the file writes them. Ratios are plain numbers: 0.01 is 1 %.
const std::vector<Key>& numberKeys() {
  static const std::vector<Key> keys{
      {"rate_hz", &ObserverProfile::rate_hz, 1, false},
      {"scale_deviation", &ObserverProfile::scale_deviation, 1, true},
      {"step_noise", &ObserverProfile::step_noise, 1, true},
      {"velocity_bias_m_s", &ObserverProfile::velocity_bias_m_s, 1, true},
      {"velocity_bias_time_s", &ObserverProfile::velocity_bias_time_s, 1, false},
      {"velocity_noise_m_s", &ObserverProfile::velocity_noise_m_s, 1, true},
      {"yaw_walk_deg_per_sqrt_m", &ObserverProfile::yaw_walk_rad_per_sqrt_m, kRadPerDeg, true},
      {"yaw_walk_deg_per_sqrt_min", &ObserverProfile::yaw_walk_rad_per_sqrt_s,
       kRadPerDeg / std::sqrt(60.0), true},
      {"attitude_bias_deg", &ObserverProfile::attitude_bias_rad, kRadPerDeg, true},
      {"attitude_bias_time_s", &ObserverProfile::attitude_bias_time_s, 1, false},
      {"attitude_noise_deg", &ObserverProfile::attitude_noise_rad, kRadPerDeg, true},
      {"delay_s", &ObserverProfile::delay_s, 1, true},
      {"loss", &ObserverProfile::loss, 1, true}};
  return keys;
}

YAML::Node loadProfiles(const std::string& path) {
  try {
    const YAML::Node root = YAML::LoadFile(path);
    if (root.IsMap()) return root;
    throw std::runtime_error(path + ": holds no observer profiles; expected 'name: {keys}'");
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(path + ": cannot be read; it should hold the observer profiles");
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(path + ": not valid YAML: " + e.what());
  }
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Sets the field that `key` names. @return what is wrong; empty when nothing
std::string setValue(const std::string& key, const YAML::Node& value, ObserverProfile& profile) {
  try {
    if (key == "bursts") {
      profile.bursts = value.as<bool>();
      return {};
    }
    for (const auto& known : numberKeys()) {
      if (key != known.name) continue;
      const auto number = value.as<double>();
      const bool large_enough = known.zero_allowed ? number >= 0 : number > 0;
      if (!std::isfinite(number) || !large_enough || (key == "loss" && number >= 1)) {
        return "'" + key + "' is out of range";
      }
      profile.*known.field = number * known.si_per_unit;
      return {};
    }
  } catch (const YAML::Exception&) {
    return "'" + key + "' has a value of the wrong type";
  }
  std::string known_names = "bursts";
  for (const auto& known : numberKeys()) known_names += std::string(", ") + known.name;
  return "'" + key + "' is not known; known are " + known_names;
}

}  // namespace

std::vector<std::string> observerProfileNames(const std::string& profiles_yaml) {
  std::vector<std::string> names;
  for (const auto& entry : loadProfiles(profiles_yaml)) {
    names.push_back(entry.first.as<std::string>());
  }
  return names;
}

ObserverProfile loadObserverProfile(const std::string& name, const std::string& profiles_yaml) {
  const YAML::Node root = loadProfiles(profiles_yaml);
  const YAML::Node section = root[name];
  if (!section || !section.IsMap()) {
    throw std::runtime_error("observer profile '" + name + "' is not in " + profiles_yaml +
                             "; known are " + join(observerProfileNames(profiles_yaml)));
  }
  ObserverProfile profile;
  profile.name = name;
  for (const auto& entry : section) {
    const std::string fault = setValue(entry.first.as<std::string>(), entry.second, profile);
    if (!fault.empty()) {
      throw std::runtime_error(profiles_yaml + ": profile '" + name + "': " + fault);
    }
  }
  return profile;
}

}  // namespace ardrone_vslam
