// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <vector>

#include "report/report_runs.hpp"

namespace ardrone_vslam {

/// Writes the files of runs while they go on, so that one that is killed leaves what it had. They
/// say so: `is_finished` of their summary is false.
class UnfinishedRuns {
 public:
  /// @param sequence, odometries  must outlive this
  UnfinishedRuns(const Sequence& sequence, const std::vector<RunOdometry>& odometries,
                 ReportOptions options);
  /// Writes two seconds after the beginning, then every ten, or more seldom where that would take
  /// more than a twentieth of the time. The first time an earlier run's files go. @throws
  /// std::runtime_error for a file that cannot be written
  void offer(const ResultsSoFar& so_far);
  /// Whether the folder holds this run's files.
  bool hasWritten() const { return has_written_; }

 private:
  const Sequence& sequence_;
  const std::vector<RunOdometry>& odometries_;
  ReportOptions options_;
  std::chrono::steady_clock::time_point next_;
  bool has_written_ = false;
};

}  // namespace ardrone_vslam
