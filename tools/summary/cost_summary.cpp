// SPDX-License-Identifier: BSD-3-Clause
#include "summary/cost_summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "ardrone_vslam/instruction_set.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

double peakMemory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

void addCost(const RunResult& run, Json& summary) {
  std::vector<double> totals_ms;
  StageTimes_ms stages_ms{};
  std::array<int, kOptionalWorkNames.size()> left_out{};
  for (const RunFrame& frame : run.frames) {
    totals_ms.push_back(total_ms(frame.times_ms));
    for (std::size_t i = 0; i < kStageCount; ++i) stages_ms[i] += frame.times_ms[i];
    for (std::size_t i = 0; i < left_out.size(); ++i) left_out[i] += frame.result.left_out[i];
  }
  const double sum_ms = std::accumulate(totals_ms.begin(), totals_ms.end(), 0.0);
  summary["ms_per_frame_median"] = quantile(totals_ms, 0.5);
  summary["ms_per_frame_p95"] = quantile(totals_ms, 0.95);
  summary["ms_per_frame_max"] = quantile(totals_ms, 1);
  const auto images = static_cast<double>(totals_ms.size());
  summary["frames_per_second"] = sum_ms > 0 ? Json(1000 * images / sum_ms) : Json(nullptr);
  Json share;
  for (std::size_t i = 0; i < kStageCount; ++i)
    share[kStageNames[i]] = sum_ms > 0 ? stages_ms[i] / sum_ms : 0.0;
  summary["stage_share"] = share;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    summary["left_out"][kOptionalWorkNames[i]] = left_out[i];
  summary["peak_rss_mb"] = peakMemory_mb();
  summary["instruction_set"] = nameOf(instructionSetInUse().set);
}

}  // namespace ardrone_vslam
