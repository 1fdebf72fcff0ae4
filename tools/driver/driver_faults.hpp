// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// What ardrone_autonomy does that a reader of its topics must stand.
enum class DriverFault {
  kMirroredYaw,
  kEpochDt,
  kZeroCovariance,
  kFusedAltitude,
  kWholeMetres,
  kUnprefixedFrame,
  kBursts,
  kUnscaledCameraInfo,
  kTogglecam
};

/// That unprefixed_frame has when none is given.
constexpr const char* kDefaultTfPrefix = "drone1";

using DriverFaults = std::set<DriverFault>;

struct DriverFaultInfo {
  DriverFault fault;
  std::string name;
  std::string summary;  ///< part of a sentence
  bool released;        ///< every flight with the released driver (1.4.1) has it
};

const std::vector<DriverFaultInfo>& driverFaults();

/// @param names  of faults; `all`, `released`: all of these
/// @throws std::invalid_argument for an unknown name, listing the known ones
DriverFaults driverFaultsNamed(const std::vector<std::string>& names);

/// Their names, in the order of driverFaults(), with commas; "none" without any.
std::string nameList(const DriverFaults& faults);

}  // namespace ardrone_vslam
