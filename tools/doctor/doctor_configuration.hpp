// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// What the SLAM runs with, or will.
struct DoctorConfiguration {
  std::string name;  ///< a file's path, or nodes; empty: it is not known
  /// A parameter as it is set there; nothing: it has its default.
  std::function<std::optional<std::string>(const std::string& section, const std::string& key)>
      valueOf;
};
/// Of a file as for replay; an empty path: the defaults.
DoctorConfiguration configurationOfFile(const std::string& path);

/// Makes warnings that it answers `kConfigured`, and sets the parameters that it has apart. Not
/// known: no warning is changed, and the parameters are compared with the shipped file that the
/// report names.
void compareWith(const DoctorConfiguration& in_force, DoctorReport& report);

}  // namespace ardrone_vslam
