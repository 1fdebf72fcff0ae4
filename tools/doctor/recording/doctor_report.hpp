// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ardrone_vslam {

enum class Verdict {
  kOk,
  kConfigured,  ///< it would be a warning, but the configuration in force answers it
  kNotChecked,  ///< the text says why
  kWarning,     ///< works all the same, perhaps with a parameter
  kFault        ///< cannot work as it is
};

/// "ok", "configured", "not checked", "warning", "fault".
const char* nameOf(Verdict verdict);

/// A parameter to set in a configuration file.
struct SuggestedParameter {
  std::string section;  ///< tracker or mapper
  std::string key;
  std::string value;
  std::string reason;
  double tolerance = 0;  ///< of a number: a configuration that is so near has it already
};

/// What one check found.
struct Finding {
  std::string check;  ///< name of the check, the same in all runs
  Verdict verdict = Verdict::kOk;
  std::string text;
  std::string remedy;  ///< what to do; empty: nothing
  /// A configuration that has all of these needs no warning; none: no parameter helps.
  std::vector<SuggestedParameter> answered_by = {};
};
using Findings = std::vector<Finding>;

struct DoctorReport {
  std::string name;     ///< of the bag
  Findings findings;    ///< in the order of the checks
  std::string vehicle;  ///< what the topics look like; empty: unknown
  std::string config_file;
  std::string in_force;  ///< a file or nodes; empty: it is not known, `config_file` is to be
  std::vector<SuggestedParameter> parameters;  ///< in which that configuration is to be changed
  std::vector<SuggestedParameter> configured;  ///< its own that are asked for
  std::string replay;            ///< command line with all of this; empty: it cannot work, or live
  std::string static_transform;  ///< command line that corrects the mounting; empty: none

  bool canWork() const;
  /// Those of `verdict`.
  std::size_t count(Verdict verdict) const;
};

/// A line for each check, what to do, the parameters as yaml to paste, a last line with the
/// verdict.
std::string textOf(const DoctorReport& report);
nlohmann::ordered_json jsonOf(const DoctorReport& report);

}  // namespace ardrone_vslam
