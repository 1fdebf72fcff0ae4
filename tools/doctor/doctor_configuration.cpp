// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/doctor_configuration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "config_files/config_file.hpp"
#include "config_files/config_path.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

std::optional<double> numberIn(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nullopt : std::optional<double>(number);
}

/// As a number; `auto` begins with 0.
std::optional<double> configuredNumber(const std::string& value) {
  return value == kAuto ? std::optional<double>(0) : numberIn(value);
}

bool isConfigured(const DoctorConfiguration& configuration, const SuggestedParameter& parameter) {
  const std::string value = configuration.valueOf(parameter.section, parameter.key)
                                .value_or(defaultValue(parameter.section, parameter.key));
  const auto has = configuredNumber(value), wanted = numberIn(parameter.value);
  const bool is_near = has && wanted && std::abs(*has - *wanted) <= parameter.tolerance;
  return value == parameter.value || is_near;
}

/// What the configuration has already.
void setApartConfigured(const DoctorConfiguration& configuration, DoctorReport& report) {
  const DoctorConfiguration defaults = configurationOfFile({});
  const auto isMissing = [&](const auto& p) { return !isConfigured(configuration, p); };
  const auto isOwn = [&](const auto& p) { return !isConfigured(defaults, p); };
  auto& parameters = report.parameters;
  const auto configured = std::stable_partition(parameters.begin(), parameters.end(), isMissing);
  std::copy_if(configured, parameters.end(), std::back_inserter(report.configured), isOwn);
  parameters.erase(configured, parameters.end());
}

/// "mapper/odometry_mode: twist", with what it is there.
std::string described(const DoctorConfiguration& configuration,
                      const SuggestedParameter& parameter) {
  const std::string &section = parameter.section, &key = parameter.key;
  const auto set = configuration.valueOf(section, key);
  return text(section, "/", key, ": ", set ? *set : defaultValue(section, key) + " (default)");
}

/// Faults stay: with them it cannot work as it is.
void acceptAnswered(const DoctorConfiguration& in_force, Finding& finding) {
  const auto& wanted = finding.answered_by;
  const auto isThere = [&](const auto& p) { return isConfigured(in_force, p); };
  if (finding.verdict != Verdict::kWarning || wanted.empty() ||
      !std::all_of(wanted.begin(), wanted.end(), isThere)) {
    return;
  }
  finding.verdict = Verdict::kConfigured;
  finding.remedy = in_force.name + " has ";
  for (const SuggestedParameter& parameter : wanted) {
    finding.remedy += (&parameter == &wanted.front() ? "" : ", ") + described(in_force, parameter);
  }
}

}  // namespace

DoctorConfiguration configurationOfFile(const std::string& path) {
  return {path, [path](const std::string& section, const std::string& key) {
            return writtenValue(path, section, key);
          }};
}

void compareWith(const DoctorConfiguration& in_force, DoctorReport& report) {
  if (in_force.name.empty()) {
    const std::string& file = report.config_file;
    setApartConfigured(configurationOfFile(file.empty() ? file : findConfigFile(file)), report);
    return;
  }
  report.in_force = in_force.name;
  for (Finding& finding : report.findings) acceptAnswered(in_force, finding);
  setApartConfigured(in_force, report);
}

}  // namespace ardrone_vslam
