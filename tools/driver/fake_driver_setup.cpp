// SPDX-License-Identifier: BSD-3-Clause
#include "driver/fake_driver_setup.hpp"

#include <stdexcept>
#include <vector>

#include "config_files/config_path.hpp"
#include "world/world_arguments.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + ",") {
    if (c != ',') {
      if (c != ' ') name += c;
      continue;
    }
    if (!name.empty()) names.push_back(name);
    name.clear();
  }
  return names;
}

/// Calls what reads a parameter's text; a refusal gets the parameter's name.
template <class Read>
void naming(const std::string& parameter, const std::string& also_known, Read read) {
  try {
    read();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(parameter + ": " + e.what() + also_known);
  }
}

}  // namespace

void checkNames(const FakeDriverConfig& config) {
  naming("autopilot", ", none (it obeys commands)", [&config] {
    if (hasAutopilot(config)) flightInfo(config.autopilot);
  });
  naming("faults", ", none", [&config] { faultsOf(config); });
  naming("camera", "", [&config] { cameraNamed(config.camera); });
}

// roslaunch takes no empty argument.
bool hasAutopilot(const FakeDriverConfig& config) {
  return !config.autopilot.empty() && config.autopilot != "none";
}

DriverFaults faultsOf(const FakeDriverConfig& config) {
  if (config.faults == "none") return {};
  return driverFaultsNamed(splitAtCommas(config.faults));
}

World worldOf(const FakeDriverConfig& config) {
  const FlightInfo& flight = flightInfo(hasAutopilot(config) ? config.autopilot : "laps");
  WorldOptions options;
  options.flight = flight.name;
  if (!config.world.empty()) options.world = config.world;
  if (hasAutopilot(config)) return makeWorldFor(options);
  return makeWorld(options.world.value_or(flight.world), flight.light, options.world_seed);
}

FakeDroneOptions droneOf(const FakeDriverConfig& config) {
  FakeDroneOptions options;
  if (hasAutopilot(config)) options.autopilot = config.autopilot;
  options.profile =
      loadOdometryProfile(config.odometry_profile, findConfigFile("odometry_profiles.yaml"));
  options.seed = static_cast<std::uint64_t>(config.seed);
  return options;
}

std::string prefixOf(const FakeDriverConfig& config, const DriverFaults& faults) {
  if (config.tf_prefix.find('/') != std::string::npos) {
    throw std::invalid_argument("tf_prefix: '" + config.tf_prefix + "' must be a name without '/'");
  }
  const bool needs_one = faults.count(DriverFault::kUnprefixedFrame) > 0;
  return config.tf_prefix.empty() && needs_one ? kDefaultTfPrefix : config.tf_prefix;
}

}  // namespace ardrone_vslam
