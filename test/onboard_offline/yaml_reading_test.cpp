// SPDX-License-Identifier: BSD-3-Clause
// vslam_onboard's own reader beside yaml-cpp's, on every file of config/.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <iomanip>
#include <sstream>

#include "config_files/config_file.hpp"
#include "folders/camera_yaml.hpp"
#include "settings/settings.hpp"
#include "support/test_paths.hpp"
#include "yaml/calibration.hpp"
#include "yaml/yaml_sections.hpp"

namespace ardrone_vslam {
namespace {

const std::string kFolder = test::packageFile("config");

std::vector<std::string> yamlFiles() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kFolder)) {
    if (entry.path().extension() == ".yaml") paths.push_back(entry.path().string());
  }
  return paths;
}

/// A sequence's items, each with a space behind it.
std::string textOf(const YAML::Node& node) {
  if (node.IsScalar()) return node.as<std::string>();
  std::string text;
  for (const auto& item : node) text += item.as<std::string>() + " ";
  return text;
}

std::string textOf(const std::string& value) {
  if (value.empty() || value.front() != '[') return value;
  std::string text;
  for (const std::string& item : listOf(value)) text += item + " ";
  return text;
}

YamlSections byYamlCpp(const std::string& path) {
  YamlSections sections;
  for (const auto& entry : YAML::LoadFile(path)) {
    const auto name = entry.first.as<std::string>();
    if (!entry.second.IsMap()) {
      if (entry.second.IsNull()) {
        sections[name];
      } else {
        sections[""][name] = textOf(entry.second);
      }
      continue;
    }
    for (const auto& value : entry.second)
      sections[name][value.first.as<std::string>()] = textOf(value.second);
  }
  return sections;
}

TEST(YamlReading, EveryFileIsReadAsYamlCppReadsIt) {
  const auto paths = yamlFiles();
  ASSERT_GE(paths.size(), 7U);
  for (const std::string& path : paths) {
    std::vector<std::string> faults;
    YamlSections sections = readYamlFile(path, faults);
    EXPECT_TRUE(faults.empty()) << faults.front();
    for (auto& section : sections) {
      for (auto& value : section.second) value.second = textOf(value.second);
    }
    EXPECT_EQ(sections, byYamlCpp(path)) << path;
  }
}

struct Writer {
  std::ostringstream* out;
  template <class T>
  void operator()(const ParameterInfo& info, const T& value) const {
    *out << info.name << '=' << ardrone_vslam::textOf(value) << '\n';
  }
};

template <class Config>
std::string written(Config config) {
  std::ostringstream out;
  visitParameters(config, Writer{&out});
  return out.str();
}

TEST(YamlReading, AConfigurationMeansTheSameAsForReplay) {
  int files = 0;
  for (const std::string& path : yamlFiles()) {
    if (byYamlCpp(path).count("tracker") == 0) continue;
    SCOPED_TRACE(path);
    ++files;
    // The mode is not offered on board.
    const std::string mode = "mapper/odometry_mode=pose";
    const Settings onboard = loadSettings(path, {mode});
    const PipelineConfig replay = loadConfig(path, {mode});
    EXPECT_EQ(written(onboard.tracker), written(replay.tracker));
    EXPECT_EQ(written(onboard.mapper), written(replay.mapper));
  }
  EXPECT_GE(files, 4);
}

TEST(YamlReading, ACalibrationIsThatOfReplay) {
  for (const auto& entry : std::filesystem::directory_iterator(kFolder + "/camera_info")) {
    const std::string path = entry.path().string();
    EXPECT_TRUE(readCalibration(path) == readCameraYaml(path)) << path;
  }
}

}  // namespace
}  // namespace ardrone_vslam
