// SPDX-License-Identifier: BSD-3-Clause
// How programs ask their user for the AR.Drone's driver and its faults.
#pragma once

#include <string>
#include <vector>

#include "driver/driver_faults.hpp"
#include "world/world_sequence.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
class Option;
}  // namespace CLI

namespace ardrone_vslam {

constexpr double kDriverImageRate_hz = 20;  ///< that its documentation states

struct DriverArguments {
  std::string name;  ///< empty: no driver
  std::vector<std::string> fault_names;
  std::string tf_prefix;
  DriverFaults faults;  ///< set by resolveDriver
  const CLI::Option* driver = nullptr;

  bool isChosen() const { return !name.empty(); }
};

/// --driver, --fault, --tf-prefix.
void addDriverOptions(CLI::App& app, DriverArguments& arguments);
/// @throws UsageError for a fault that is none, and for what does not go with a driver or without
void resolveDriver(DriverArguments& arguments, const WorldOptions& world);

}  // namespace ardrone_vslam
