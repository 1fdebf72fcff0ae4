// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/recording/doctor_report.hpp"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace ardrone_vslam {
namespace {

constexpr int kNameWidth = 20;
constexpr int kVerdictWidth = 13;

std::string verdictLine(const DoctorReport& report) {
  std::ostringstream line;
  line << report.name << ": " << (report.canWork() ? "usable" : "cannot work as it is") << " ("
       << report.count(Verdict::kFault) << " faults, " << report.count(Verdict::kWarning)
       << " warnings, " << report.count(Verdict::kNotChecked) << " not checked)";
  return line.str();
}

std::string yamlOf(const std::vector<SuggestedParameter>& parameters) {
  std::ostringstream yaml;
  for (const std::string section : {"tracker", "mapper"}) {
    bool has_head = false;
    for (const SuggestedParameter& parameter : parameters) {
      if (parameter.section != section) continue;
      if (!has_head) yaml << section << ":\n";
      has_head = true;
      yaml << "  " << parameter.key << ": " << parameter.value << "  # " << parameter.reason
           << '\n';
    }
  }
  return yaml.str();
}

std::string configuredOf(const std::vector<SuggestedParameter>& parameters) {
  std::string list;
  for (const SuggestedParameter& parameter : parameters) {
    list += (list.empty() ? ", which has " : ", ") + parameter.section + "/" + parameter.key;
  }
  return list;
}

}  // namespace

const char* nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kConfigured:
      return "configured";
    case Verdict::kNotChecked:
      return "not checked";
    case Verdict::kWarning:
      return "warning";
    case Verdict::kFault:
      return "fault";
  }
  return "";
}

std::size_t DoctorReport::count(Verdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [verdict](const Finding& finding) { return finding.verdict == verdict; }));
}

bool DoctorReport::canWork() const {
  return count(Verdict::kFault) == 0;
}

std::string textOf(const DoctorReport& report) {
  std::ostringstream text;
  for (const Finding& finding : report.findings) {
    text << std::left << std::setw(kVerdictWidth) << nameOf(finding.verdict)
         << std::setw(kNameWidth) << finding.check << finding.text << '\n';
    if (finding.remedy.empty()) continue;
    text << std::string(kVerdictWidth + kNameWidth, ' ') << "-> " << finding.remedy << '\n';
  }
  if (!report.in_force.empty()) {
    text << "\nIn force: " << report.in_force << configuredOf(report.configured) << '\n';
  } else if (!report.vehicle.empty()) {
    text << "\nLooks like " << report.vehicle << ": begin with config/" << report.config_file
         << configuredOf(report.configured) << '\n';
  }
  if (!report.parameters.empty()) text << "\nParameters:\n" << yamlOf(report.parameters);
  if (!report.replay.empty()) text << "\nReplay:\n" << report.replay << '\n';
  if (!report.static_transform.empty()) {
    text << "\nThe camera's mounting, in place of what tf says:\n"
         << report.static_transform << '\n';
  }
  text << '\n' << verdictLine(report) << '\n';
  return text.str();
}

nlohmann::ordered_json jsonOf(const DoctorReport& report) {
  nlohmann::ordered_json json;
  json["input"] = report.name;
  json["usable"] = report.canWork();
  json["faults"] = report.count(Verdict::kFault);
  json["warnings"] = report.count(Verdict::kWarning);
  json["not_checked"] = report.count(Verdict::kNotChecked);
  json["checks"] = nlohmann::ordered_json::array();
  for (const Finding& finding : report.findings) {
    json["checks"].push_back({{"check", finding.check},
                              {"verdict", nameOf(finding.verdict)},
                              {"text", finding.text},
                              {"remedy", finding.remedy}});
  }
  json["vehicle"] = report.vehicle;
  json["config_file"] = report.config_file;
  json["in_force"] = report.in_force;
  json["parameters"] = nlohmann::ordered_json::object();
  for (const SuggestedParameter& parameter : report.parameters) {
    json["parameters"][parameter.section + "/" + parameter.key] = {{"value", parameter.value},
                                                                   {"reason", parameter.reason}};
  }
  json["replay"] = report.replay;
  json["static_transform"] = report.static_transform;
  return json;
}

}  // namespace ardrone_vslam
