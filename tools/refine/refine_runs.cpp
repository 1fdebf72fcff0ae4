// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine_runs.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "ardrone_vslam/rotation.hpp"
#include "program/progress_line.hpp"
#include "refine/refined_map.hpp"
#include "refine/refined_path.hpp"
#include "refine/refinement.hpp"

namespace ardrone_vslam {

namespace {

void refineRun(RunResult& run, const RefinementProgress& progress) {
  if (!run.record.is_whole)
    throw std::runtime_error(
        "the odometry began anew on the way; cut the recording there and refine each part");
  const auto begin = std::chrono::steady_clock::now();
  const Refinement refinement =
      refine(run.record, run.map ? run.map->anchors : std::vector<MapAnchor>{}, progress);
  RefinedRun& refined = run.refined.emplace();
  refined.T_map_base = refinedPath(run, refinement);
  refined.keyframes = refinement.T_map_base.size();
  refined.points = refinement.points.size();
  refined.views = refinement.views;
  refined.views_left_out = refinement.views_left_out;
  if (!refinement.R_base_rig.empty())
    refined.extrinsics_error_rad = rotationVectorOf(refinement.R_base_rig.back());
  refined.extrinsics_sigma_rad = refinement.extrinsics_sigma_rad;
  if (run.map) run.map = refinedMap(std::move(*run.map), run.record, refinement);
  refined.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::string faultOfRefining(const SlamConfig& config) {
  if (config.estimator != EstimatorKind::kMsckf)
    return "--refine: needs the keyframes of estimator: msckf";
  return "";
}

std::vector<std::string> refineRuns(std::vector<RunResult>& runs) {
  constexpr std::size_t kOfOne = 100;
  std::vector<std::string> faults;
  ProgressLine line("replay: refining", kOfOne * runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    try {
      refineRun(runs[i], [&](double share) {
        line.update(kOfOne * i + static_cast<std::size_t>(kOfOne * share));
      });
    } catch (const std::runtime_error& e) {
      faults.push_back(std::string("not refined: ") + e.what());
    }
    line.update(kOfOne * (i + 1));
  }
  return faults;
}

}  // namespace ardrone_vslam
