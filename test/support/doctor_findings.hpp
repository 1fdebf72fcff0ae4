// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam::test {

/// The finding of a check; a fault named "no such check" when there is none.
inline Finding findingOf(const Findings& findings, const std::string& check) {
  for (const Finding& finding : findings) {
    if (finding.check == check) return finding;
  }
  return {"no such check", Verdict::kFault, check, {}};
}

/// Its verdict alone.
inline Verdict verdictOf(const Findings& findings, const std::string& check) {
  return findingOf(findings, check).verdict;
}

/// Names of the checks that warn or tell a fault.
inline std::set<std::string> found(const Findings& findings) {
  std::set<std::string> names;
  for (const Finding& finding : findings) {
    if (finding.verdict == Verdict::kWarning || finding.verdict == Verdict::kFault)
      names.insert(finding.check);
  }
  return names;
}

}  // namespace ardrone_vslam::test
