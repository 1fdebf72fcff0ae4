// SPDX-License-Identifier: BSD-3-Clause
#include "report/unfinished_runs.hpp"

#include <algorithm>
#include <utility>

#include "report/earlier_run.hpp"

namespace ardrone_vslam {
namespace {

using namespace std::chrono_literals;
constexpr auto kFirst = 2s;
constexpr auto kBetween = 10s;
constexpr int kShare = 20;

}  // namespace

UnfinishedRuns::UnfinishedRuns(const Sequence& sequence, const std::vector<RunOdometry>& odometries,
                               ReportOptions options)
    : sequence_(sequence),
      odometries_(odometries),
      options_(std::move(options)),
      next_(std::chrono::steady_clock::now() + kFirst) {}

void UnfinishedRuns::offer(const ResultsSoFar& so_far) {
  const auto began = std::chrono::steady_clock::now();
  if (began < next_) return;
  const std::vector<RunResult> results = so_far();
  if (!results.front().frames.empty()) {
    if (!has_written_) removeEarlierRun(options_.folder);
    has_written_ = true;
    reportRuns(sequence_, odometries_, results, options_);
  }
  const auto ended = std::chrono::steady_clock::now();
  next_ = ended + std::max<std::chrono::steady_clock::duration>(kBetween, kShare * (ended - began));
}

}  // namespace ardrone_vslam
