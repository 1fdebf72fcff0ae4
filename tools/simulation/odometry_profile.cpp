// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "files/regular_file.hpp"
#include "simulation/odometry_model.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRadPerDeg = M_PI / 180;

struct Key {
  const char* name;
  double OdometryProfile::*field;
  double si_per_unit;
  bool zero_allowed;
};

/// Numbers of a profile as the file writes them. Ratios are plain numbers: 0.01 is 1 %.
const std::vector<Key>& numberKeys() {
  static const std::vector<Key> keys{
      {"rate_hz", &OdometryProfile::rate_hz, 1, false},
      {"scale_sigma", &OdometryProfile::scale_sigma, 1, true},
      {"step_noise", &OdometryProfile::step_noise, 1, true},
      {"velocity_bias_m_s", &OdometryProfile::velocity_bias_m_s, 1, true},
      {"velocity_bias_time_s", &OdometryProfile::velocity_bias_time_s, 1, false},
      {"velocity_noise_m_s", &OdometryProfile::velocity_noise_m_s, 1, true},
      {"yaw_scale_sigma", &OdometryProfile::yaw_scale_sigma, 1, true},
      {"yaw_walk_deg_per_sqrt_m", &OdometryProfile::yaw_walk_rad_per_sqrt_m, kRadPerDeg, true},
      {"yaw_walk_deg_per_sqrt_min", &OdometryProfile::yaw_walk_rad_per_sqrt_s,
       kRadPerDeg / std::sqrt(60.0), true},
      {"attitude_bias_deg", &OdometryProfile::attitude_bias_rad, kRadPerDeg, true},
      {"attitude_bias_time_s", &OdometryProfile::attitude_bias_time_s, 1, false},
      {"attitude_noise_deg", &OdometryProfile::attitude_noise_rad, kRadPerDeg, true},
      {"delay_s", &OdometryProfile::delay_s, 1, true},
      {"loss", &OdometryProfile::loss, 1, true}};
  return keys;
}

YAML::Node loadProfiles(const std::string& path) {
  const std::string text = readYamlText(path, "it should hold the odometry profiles");
  try {
    const YAML::Node root = YAML::Load(text);
    if (root.IsMap()) return root;
    throw std::runtime_error(path + ": holds no odometry profiles; expected 'name: {keys}'");
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
std::string setValue(const std::string& key, const YAML::Node& value, OdometryProfile& profile) {
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

OdometryProfile loadOne(const std::string& name, const std::string& profiles_yaml) {
  const YAML::Node root = loadProfiles(profiles_yaml);
  const YAML::Node section = root[name];
  if (!section || !section.IsMap()) {
    throw std::runtime_error("odometry profile '" + name + "' is not in " + profiles_yaml +
                             "; known are " + join(odometryProfileNames(profiles_yaml)));
  }
  OdometryProfile profile;
  profile.name = name;
  for (const auto& entry : section) {
    const std::string fault = setValue(entry.first.as<std::string>(), entry.second, profile);
    if (!fault.empty()) {
      throw std::runtime_error(profiles_yaml + ": profile '" + name + "': " + fault);
    }
  }
  return profile;
}

/// "B@S". @throws std::runtime_error
OdometryProfile loadLater(const std::string& text, double after_s,
                          const std::string& profiles_yaml) {
  const auto at = text.find('@');
  double from_s = 0;
  char rest = 0;
  if (at == std::string::npos || std::sscanf(text.c_str() + at + 1, "%lf%c", &from_s, &rest) != 1 ||
      !(from_s > after_s) || !std::isfinite(from_s)) {
    throw std::runtime_error("odometry profile '" + text +
                             "' must be NAME@SECONDS, the seconds ascending, as in "
                             "drone,hover@20");
  }
  OdometryProfile profile = loadOne(text.substr(0, at), profiles_yaml);
  profile.from_s = from_s;
  return profile;
}

}  // namespace

std::vector<std::string> odometryProfileNames(const std::string& profiles_yaml) {
  std::vector<std::string> names;
  for (const auto& entry : loadProfiles(profiles_yaml)) {
    names.push_back(entry.first.as<std::string>());
  }
  return names;
}

OdometryProfile loadOdometryProfile(const std::string& name, const std::string& profiles_yaml) {
  auto end = name.find(',');
  OdometryProfile profile = loadOne(name.substr(0, end), profiles_yaml);
  profile.name = name;
  while (end != std::string::npos) {
    const auto begin = end + 1;
    end = name.find(',', begin);
    const double after_s = profile.later.empty() ? 0 : profile.later.back().from_s;
    profile.later.push_back(loadLater(name.substr(begin, end - begin), after_s, profiles_yaml));
  }
  return profile;
}

}  // namespace ardrone_vslam
