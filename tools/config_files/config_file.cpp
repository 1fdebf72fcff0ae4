// SPDX-License-Identifier: BSD-3-Clause
#include "config_files/config_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "configs/node_config.hpp"
#include "configs/onboard_config.hpp"
#include "configs/section_values.hpp"
#include "files/regular_file.hpp"

namespace ardrone_vslam {
namespace {

constexpr const char* kListOfAll = " (docs/parameters.md and --list-parameters name all)";
constexpr const char* kOdometryFusion = "odometry_fusion";
constexpr const char* kOnboard = "onboard";

using Section = std::map<std::string, std::string>;  // key -> value as written

struct ReadYaml {
  template <class T>
  bool operator()(const std::string& text, T& value) const {
    try {
      value = YAML::Load(text).as<T>();
      return true;
    } catch (const YAML::Exception&) {
      return false;
    }
  }
};
using SectionReader = SectionValues<ReadYaml>;

/// roslaunch takes the last of two without a word, and so leaves out what the first one sets.
std::string twice(const std::string& section) {
  return "section '" + section + "' is there twice; put all its keys under one '" + section + ":'";
}

/// A section's keys and their values as text.
Section readSection(const std::string& path, const std::string& name, const YAML::Node& node,
                    std::vector<std::string>& faults) {
  Section section;
  if (node.IsNull()) return section;  // its keys are all commented out
  if (!node.IsMap()) {
    faults.push_back(path + ": '" + name + "' must be a section of keys (tracker: or mapper:)");
    return section;
  }
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    const std::string value =
        entry.second.IsScalar() ? entry.second.as<std::string>() : YAML::Dump(entry.second);
    if (!section.emplace(key, value).second)
      faults.push_back(path + ": '" + name + "/" + key + "' is there twice; keep one of them");
  }
  return section;
}

std::map<std::string, Section> readSections(const std::string& path,
                                            std::vector<std::string>& faults) {
  std::map<std::string, Section> sections;
  if (path.empty()) return sections;
  try {
    const YAML::Node root = YAML::Load(readYamlText(path));
    if (!root.IsMap() && !root.IsNull()) {
      faults.push_back(path + ": must hold the sections tracker: and mapper:");
      return sections;
    }
    for (const auto& section : root) {
      const auto name = section.first.as<std::string>();
      if (sections.count(name) > 0) faults.push_back(path + ": " + twice(name));
      sections.emplace(name, readSection(path, name, section.second, faults));
    }
  } catch (const YAML::Exception& e) {
    faults.push_back(path + ": not valid YAML: " + e.what());
  } catch (const std::runtime_error& e) {
    faults.push_back(e.what());
  }
  return sections;
}

template <class Config>
bool hasParameter(Config config, const std::string& key) {
  bool found = false;
  visitParameters(config,
                  [&](const ParameterInfo& info, auto&) { found = found || key == info.name; });
  return found;
}

/// Keys that the nodelets read beside the stages' parameters (topics, frames); the offline tools
/// pass over them, but for `rectified`, `rescale_calibration` and `base_frame`.
bool isNodeKey(const std::string& section, const std::string& key) {
  if (section == "tracker") return hasParameter(TrackerNodeConfig{}, key);
  if (section == kOdometryFusion) return hasParameter(OdometryFusionNodeConfig{}, key);
  if (section == kOnboard) return false;
  return hasParameter(MapperNodeConfig{}, key);
}

template <class Config>
void addNames(Config config, std::set<std::string>& names) {
  visitParameters(config, [&](const ParameterInfo& info, auto&) { names.insert(info.name); });
}

/// Writes the value of one parameter.
struct ValueWriter {
  std::string key;
  std::ostringstream* out;

  template <class T>
  void operator()(const ParameterInfo& info, const T& value) const {
    if (key == info.name) *out << textOf(value);
  }
};

template <class Config>
void writeDefault(Config config, const std::string& key, std::ostringstream& out) {
  visitParameters(config, ValueWriter{key, &out});
}

/// Over tracker and mapper, whose keys are often put into the wrong one; odometry_fusion's own.
std::string hintFor(const std::string& section, const std::string& written) {
  std::set<std::string> names;
  if (section == kOdometryFusion || section == kOnboard) {
    section == kOnboard ? addNames(OnboardConfig{}, names) : addNames(DelayedFusionConfig{}, names);
    return remedyFor(section, written, names);
  }
  std::string became = whatBecameOf(OldName::Kind::kParameter, written);
  if (!became.empty()) return became;
  addNames(TrackerConfig{}, names);
  addNames(SlamConfig{}, names);
  const std::string nearest = nearestName(written, names);
  if (nearest.empty()) return {};
  return std::string("; did you mean ") +
         (hasParameter(TrackerConfig{}, nearest) ? "tracker/" : "mapper/") + nearest;
}

/// Of a key written without its section; empty when no section has it.
std::string sectionOf(const std::string& key) {
  if (hasParameter(TrackerConfig{}, key)) return "tracker";
  if (hasParameter(SlamConfig{}, key) || isNodeKey("mapper", key)) return "mapper";
  return isNodeKey("tracker", key) ? "tracker" : "";
}

void applyOverride(const std::string& text, std::map<std::string, Section>& sections,
                   std::vector<std::string>& faults) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    faults.push_back("--set '" + text + "' must be key=value, for example features_per_frame=500");
    return;
  }
  std::string key = text.substr(0, equals);
  const std::string value = text.substr(equals + 1);
  const auto slash = key.find('/');
  std::string section = sectionOf(key);
  if (slash != std::string::npos) {
    section = key.substr(0, slash);
    key = key.substr(slash + 1);
  }
  if (section.empty()) {
    faults.push_back("--set '" + text + "': " + key + " is not a parameter" + hintFor("", key) +
                     kListOfAll);
    return;
  }
  sections[section][key] = value;
}

template <class Config>
void readSection(const char* name, std::map<std::string, Section>& sections, Config& config,
                 std::vector<std::string>& faults) {
  Section values = sections[name];
  sections.erase(name);
  visitParameters(config, SectionReader{name, &values, &faults});
  for (const auto& leftover : values) {
    if (isNodeKey(name, leftover.first)) continue;
    faults.push_back(std::string(name) + "/" + leftover.first + " is not a parameter" +
                     hintFor(name, leftover.first) + kListOfAll);
  }
  const auto range_faults = rangeFaults(config);
  faults.insert(faults.end(), range_faults.begin(), range_faults.end());
}

}  // namespace

PipelineConfig loadConfig(const std::string& path, const std::vector<std::string>& overrides) {
  std::vector<std::string> faults;
  auto sections = readSections(path, faults);
  for (const auto& text : overrides) applyOverride(text, sections, faults);
  PipelineConfig config;
  const ParameterInfo rectified{"rectified", "switch", 0, 0, ""};
  SectionReader{"tracker", &sections["tracker"], &faults}(rectified, config.rectified);
  const ParameterInfo rescale{"rescale_calibration", "switch", 0, 0, ""};
  SectionReader{"tracker", &sections["tracker"], &faults}(rescale, config.rescale_calibration);
  const ParameterInfo base_frame{"base_frame", "name", 0, 0, ""};
  SectionReader{"mapper", &sections["mapper"], &faults}(base_frame, config.base_frame);
  readSection("tracker", sections, config.tracker, faults);
  readSection("mapper", sections, config.mapper, faults);
  if (sections.count(kOdometryFusion) > 0) {
    DelayedFusionConfig delayed_fusion;  // of no use offline, but its keys are checked all the same
    readSection(kOdometryFusion, sections, delayed_fusion, faults);
  }
  if (sections.count(kOnboard) > 0) {
    OnboardConfig onboard;  // likewise
    readSection(kOnboard, sections, onboard, faults);
  }
  for (const auto& section : sections) {
    faults.push_back("unknown section '" + section.first + "'" +
                     whatBecameOf(OldName::Kind::kSection, section.first) +
                     "; known are tracker, mapper, odometry_fusion and onboard");
  }
  if (!faults.empty()) throw ConfigError(faults);
  return config;
}

std::optional<std::string> writtenValue(const std::string& path, const std::string& section,
                                        const std::string& key) {
  std::vector<std::string> faults;
  Section values = readSections(path, faults)[section];
  if (!faults.empty()) throw ConfigError(faults);
  if (values.count(key) == 0) return std::nullopt;
  return values[key];
}

std::string defaultValue(const std::string& section, const std::string& key) {
  std::ostringstream text;
  if (section == "tracker") {
    writeDefault(TrackerConfig{}, key, text);
    writeDefault(TrackerNodeConfig{}, key, text);
  } else {
    writeDefault(SlamConfig{}, key, text);
    writeDefault(MapperNodeConfig{}, key, text);
  }
  return text.str();
}

}  // namespace ardrone_vslam
