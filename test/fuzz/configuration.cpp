// SPDX-License-Identifier: BSD-3-Clause
// Configurations and calibrations, by both of their readers: refused with a reason, or values
// within their bounds that both read alike.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "config_files/config_file.hpp"
#include "folders/camera_yaml.hpp"
#include "fuzz/fuzz_input.hpp"
#include "protocol/udp.hpp"
#include "sequences/sequence.hpp"
#include "settings/settings.hpp"
#include "simulation/odometry_model.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"
#include "yaml/calibration.hpp"

namespace ardrone_vslam::fuzz {
namespace {

enum Kind : std::uint8_t { kConfig, kCalibration, kOverrides, kProfiles, kArguments, kKinds };

struct ValueCollector {
  std::map<std::string, std::string>* values;
  template <class T>
  void operator()(const ParameterInfo& info, const T& value) const {
    (*values)[info.name] = textOf(value);
  }
};

template <class Config>
void requireWithinBounds(Config config) {
  require(rangeFaults(config).empty(), "values are within their bounds");
}

template <class Config>
void requireSame(Config a, Config b) {
  std::map<std::string, std::string> of_a;
  std::map<std::string, std::string> of_b;
  visitParameters(a, ValueCollector{&of_a});
  visitParameters(b, ValueCollector{&of_b});
  for (const auto& [name, value] : of_a)
    require(value == of_b[name], name + " is '" + value + "' and '" + of_b[name] + "'");
}

std::optional<PipelineConfig> loaded(const std::string& path,
                                     const std::vector<std::string>& overrides) {
  try {
    const PipelineConfig config = loadConfig(path, overrides);
    requireWithinBounds(config.tracker);
    requireWithinBounds(config.mapper);
    return config;
  } catch (const ConfigError& error) {
    require(error.what()[0] != '\0', "what is refused has a reason");
  }
  return std::nullopt;
}

std::optional<Settings> loadedOnboard(const std::string& path,
                                      const std::vector<std::string>& overrides) {
  try {
    const Settings settings = loadSettings(path, overrides);
    requireWithinBounds(settings.onboard);
    requireWithinBounds(settings.tracker);
    requireWithinBounds(settings.mapper);
    require(extrinsicsOf(settings.onboard).matrix().allFinite(), "extrinsics are finite");
    return settings;
  } catch (const ConfigError& error) {
    require(error.what()[0] != '\0', "what is refused has a reason");
  }
  return std::nullopt;
}

void readConfig(const std::string& path) {
  const auto config = loaded(path, {});
  const auto settings = loadedOnboard(path, {});
  if (!config || !settings) return;
  requireSame(config->tracker, settings->tracker);
  requireSame(config->mapper, settings->mapper);
}

void readOverrides(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);
  loaded("", overrides);
  loadedOnboard("", overrides);
}

template <class Reader>
std::optional<CameraIntrinsics> readBy(const Reader& reader, const std::string& path) {
  try {
    return reader(path);
  } catch (const std::runtime_error& error) {
    require(std::string(error.what()).find(path) != std::string::npos, "errors name the file");
  }
  return std::nullopt;
}

void readCalibrations(const std::string& path) {
  const auto onboard = readBy(readCalibration, path);
  const auto offline = readBy(readCameraYaml, path);
  if (onboard) require(calibrationFault(*onboard).empty(), "what is taken has no fault");
  if (onboard && offline) require(*onboard == *offline, "both readers read the same camera");
}

void readProfiles(const std::string& path) {
  try {
    loadOdometryProfile("drone,wheels@5", path);
  } catch (const std::runtime_error& error) {
    require(std::string(error.what()).find(path) != std::string::npos, "errors name the file");
  }
}

void readArguments(const std::string& text) {
  try {
    udpAddressOf(text, 5580);
  } catch (const std::runtime_error&) {
  }
  isUdpAddress(text);
  try {
    FrameSelection::parse(text, false);
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  const auto add = [&all](Kind kind, const std::string& text) {
    Bytes bytes = bytesOf(text);
    bytes.insert(bytes.begin(), kind);
    all.push_back(bytes);
  };
  const std::string folder = test::packageFile("config");
  std::map<std::string, std::string> files;  // by name: the order of folders is no order
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream file(entry.path());
    files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
  }
  for (const auto& [name, text] : files) {
    const bool is_camera = text.find("image_width") != std::string::npos;
    const bool is_profiles = name.find("profiles") != std::string::npos;
    add(is_camera ? kCalibration : is_profiles ? kProfiles : kConfig, text);
  }
  add(kConfig, "mapper:\n  planar: true\n  max_landmarks: 500\ntracker: {features_per_frame: 9}\n");
  add(kConfig, "mapper: &m\n  planar: *m\nonboard:\n  camera_position_m: [0, -1.5e-3, \"7\"]\n");
  add(kOverrides, "mapper/planar=yes\ntracker/features_per_frame=10\nimage_time_offset_s=auto\n");
  add(kArguments, "192.168.1.1:5580");
  add(kArguments, "10:20:3");
  return all;
}

std::size_t repair(std::uint8_t* /*data*/, std::size_t size, std::size_t /*most_size*/) {
  return size;
}

}  // namespace ardrone_vslam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ardrone_vslam::fuzz;
  static const ardrone_vslam::TemporaryFolder folder;
  FuzzInput input(data, size);
  const auto kind = static_cast<Kind>(input.take<std::uint8_t>() % kKinds);
  const std::string path = folder.file("a.yaml");
  folder.write("a.yaml", input.text());
  switch (kind) {
    case kConfig:
      readConfig(path);
      break;
    case kCalibration:
      readCalibrations(path);
      break;
    case kOverrides:
      readOverrides(input.text());
      break;
    case kProfiles:
      readProfiles(path);
      break;
    default:
      readArguments(input.text());
  }
  return 0;
}
