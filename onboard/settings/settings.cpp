// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "ardrone_vslam/rotation.hpp"
#include "configs/node_config.hpp"
#include "configs/section_values.hpp"
#include "files/shortened.hpp"
#include "yaml/yaml_sections.hpp"

namespace ardrone_vslam {
namespace {

using Section = std::map<std::string, std::string>;

struct ReadText {
  bool operator()(const std::string& text, bool& value) const { return toSwitch(text, value); }
  bool operator()(const std::string& text, int& value) const { return toNumber(text, value); }
  bool operator()(const std::string& text, double& value) const { return toNumber(text, value); }
};
using ValueReader = SectionValues<ReadText>;

struct NameCollector {
  std::set<std::string>* names;
  template <class T>
  void operator()(const ParameterInfo& info, T&) const {
    names->insert(info.name);
  }
};

/// Sections and their structs, one after the other.
class SectionReader {
 public:
  SectionReader(YamlSections sections, std::vector<std::string>& faults)
      : sections_(std::move(sections)), faults_(faults) {}

  template <class... Configs>
  void read(const std::string& name, Configs&... configs) {
    Section values = sections_[name];
    sections_.erase(name);
    std::set<std::string> names;
    (visitParameters(configs, ValueReader{name, &values, &faults_}), ...);
    (visitParameters(configs, NameCollector{&names}), ...);
    for (const auto& leftover : values) {
      faults_.push_back(name + "/" + leftover.first + " is not a parameter" +
                        remedyFor(name, leftover.first, names));
    }
    (addRangeFaults(configs), ...);
  }

  void refuseOthers() {
    for (const auto& section : sections_) {
      if (section.first.empty() && section.second.empty()) continue;
      faults_.push_back("unknown section '" + section.first + "'" +
                        whatBecameOf(OldName::Kind::kSection, section.first) +
                        "; known are onboard, tracker, mapper and odometry_fusion");
    }
  }

 private:
  template <class Config>
  void addRangeFaults(const Config& config) {
    const auto faults = rangeFaults(config);
    faults_.insert(faults_.end(), faults.begin(), faults.end());
  }

  YamlSections sections_;
  std::vector<std::string>& faults_;
};

void apply(const std::string& text, YamlSections& sections, std::vector<std::string>& faults) {
  const std::size_t equals = text.find('=');
  const std::size_t slash = text.find('/');
  if (equals == std::string::npos || slash == std::string::npos || slash > equals) {
    faults.push_back("--set '" + text +
                     "' must be section/key=value, for example mapper/planar=true");
    return;
  }
  sections[text.substr(0, slash)][text.substr(slash + 1, equals - slash - 1)] =
      text.substr(equals + 1);
}

void besideFile(const std::string& path, std::string& name) {
  const std::size_t slash = path.rfind('/');
  if (!name.empty() && name.front() != '/' && slash != std::string::npos)
    name = path.substr(0, slash + 1) + name;
}

void readVector(const std::string& name, const std::string& text, Eigen::Vector3d& value,
                std::vector<std::string>& faults) {
  constexpr double kMost = 1000;  // metres or degrees
  const std::vector<std::string> items = listOf(text);
  bool is_good = items.size() == 3;
  for (std::size_t i = 0; is_good && i < 3; ++i) {
    double& number = value[static_cast<int>(i)];
    is_good = toNumber(items[i], number) && std::abs(number) <= kMost;
  }
  if (!is_good)
    faults.push_back("onboard/" + name + " is '" + shortened(text) +
                     "' but must be three numbers between -1000 and 1000, as [0, -0.02, 0]");
}

}  // namespace

Settings loadSettings(const std::string& path, const std::vector<std::string>& overrides) {
  std::vector<std::string> faults;
  YamlSections sections;
  if (!path.empty()) sections = readYamlFile(path, faults);
  besideFile(path, sections["onboard"]["camera"]);
  for (const std::string& text : overrides) apply(text, sections, faults);
  SectionReader reader(std::move(sections), faults);
  Settings s;
  TrackerNodeConfig tracker_node;
  MapperNodeConfig mapper_node;
  OdometryFusionNodeConfig fusion_node;
  DelayedFusionConfig delayed_fusion;
  reader.read("onboard", s.onboard);
  reader.read("tracker", s.tracker, tracker_node);
  reader.read("mapper", s.mapper, mapper_node);
  reader.read("odometry_fusion", delayed_fusion, fusion_node);
  reader.refuseOthers();
  // What needs topics that are not here.
  if (s.mapper.odometry_adapter.mode != OdometryMode::kPose)
    faults.push_back("mapper/odometry_mode must be pose: the controller's records hold no more");
  if (s.tracker.use_attitude) faults.push_back("tracker/use_attitude must be false on board");
  const bool has_maps = !mapper_node.map_file.empty() || !mapper_node.save_map.empty();
  if (const std::string fault = faultOfMaps(s.mapper); has_maps && !fault.empty())
    faults.push_back(fault + ", or map_file and save_map to \"\"");
  Eigen::Vector3d unused;
  readVector("camera_position_m", s.onboard.camera_position_m, unused, faults);
  readVector("camera_rotation_deg", s.onboard.camera_rotation_deg, unused, faults);
  if (!faults.empty()) throw ConfigError(faults);
  s.odometry_wait_s = mapper_node.odometry_wait_s;
  s.map_file = mapper_node.map_file;
  s.save_map = mapper_node.save_map;
  s.autosave_s = mapper_node.autosave.period_s();
  return s;
}

std::size_t memory_bytes(const Settings& settings) {
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(settings.onboard.working_mb) * 1'000'000 +
      static_cast<std::uint64_t>(settings.mapper.landmark_map.most()) * kLandmark_bytes;
  // More than there are addresses cannot be had either.
  return static_cast<std::size_t>(std::min<std::uint64_t>(bytes, SIZE_MAX));
}

Eigen::Isometry3d extrinsicsOf(const OnboardConfig& config) {
  Eigen::Vector3d position_m;
  Eigen::Vector3d rotation_deg;
  std::vector<std::string> faults;
  readVector("camera_position_m", config.camera_position_m, position_m, faults);
  readVector("camera_rotation_deg", config.camera_rotation_deg, rotation_deg, faults);
  if (!faults.empty()) throw ConfigError(faults);
  const auto rotation = [&rotation_deg](int axis) {
    return rotationOf(rotation_deg[axis] * M_PI / 180 * Eigen::Vector3d::Unit(axis));
  };
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  T_base_cam.translation() = position_m;
  T_base_cam.linear() = rotation(2) * rotation(1) * rotation(0);
  return T_base_cam;
}

}  // namespace ardrone_vslam
