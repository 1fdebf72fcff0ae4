// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/offline_run.hpp"
#include "run/run_odometry.hpp"
#include "sequences/sequence.hpp"

namespace ardrone_vslam {

struct ReportOptions {
  std::string folder;     ///< gets what the runs write
  bool is_of_seeds;       ///< each run in its seedFolder(), and a summary of all
  std::string estimator;  ///< which they used
  std::function<void(const std::string& warning)> warn;  ///< gets what a user should know first
};

/// Writes the files of a sequence's runs with each of the odometries; judges them and prints their
/// numbers on stdout when they are finished. @param results  as many as odometries
/// @return what is wrong with the input: then the results are not to be used
/// @throws std::runtime_error for a file that cannot be written, or when nothing came out at all
std::vector<std::string> reportRuns(const Sequence& sequence,
                                    const std::vector<RunOdometry>& odometries,
                                    const std::vector<RunResult>& results,
                                    const ReportOptions& options);

}  // namespace ardrone_vslam
