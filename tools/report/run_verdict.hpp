// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "summary/run_report.hpp"

namespace ardrone_vslam {

/// What a user should know before believing a run's numbers, sentences with what helps.
struct RunVerdict {
  std::vector<std::string> warnings;
  std::vector<std::string> faults;  ///< the results are not to be used: exit code 1
};

/// @param truth_moved  of truthFromOdometryStart
/// @throws std::runtime_error naming the sequence when nothing came out at all
RunVerdict judgeRun(const std::string& name, const RunResult& run, const RunEvaluation& evaluation,
                    bool truth_moved);

}  // namespace ardrone_vslam
