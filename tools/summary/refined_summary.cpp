// SPDX-License-Identifier: BSD-3-Clause
#include "summary/refined_summary.hpp"

#include <nlohmann/json.hpp>

#include "trajectory/metrics.hpp"

namespace ardrone_vslam {

Trajectory refinedTrajectory(const RunResult& run) {
  Trajectory path;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    path.append({run.frames[i].exposed_ns(), run.refined->T_map_base[i]});
  return path;
}

void addRefinement(const RunResult& run, const Trajectory& truth, nlohmann::ordered_json& summary) {
  if (!run.refined) return;
  for (const char* key : {"refined_ate_rmse_m", "refined_error_max_m",
                          "refined_ate_rmse_scale_removed_m", "refined_ate_rmse_aligned_m"})
    summary[key] = nullptr;
  if (!truth.empty()) {
    const Trajectory refined = refinedTrajectory(run);
    Trajectory path;
    for (const StampedPose& pose : truth.poses())
      path.append({pose.stamp_ns, refined.at(pose.stamp_ns)});
    const ErrorSummary errors = summarise(positionErrors_m(path, truth));
    const Trajectory as_odometry = scaled(truth, run.scale_error);
    summary["refined_ate_rmse_m"] = errors.rmse_m;
    summary["refined_error_max_m"] = errors.max_m;
    summary["refined_ate_rmse_scale_removed_m"] =
        summarise(positionErrors_m(path, as_odometry)).rmse_m;
    summary["refined_ate_rmse_aligned_m"] = alignedRmse_m(path, truth);
  }
  summary["refined_keyframes"] = run.refined->keyframes;
  summary["refined_points"] = run.refined->points;
  summary["refined_views"] = run.refined->views;
  summary["refined_views_left_out"] = run.refined->views_left_out;
  const auto inDegrees = [](const Eigen::Vector3d& rad) {
    const Eigen::Vector3d deg = 180 / M_PI * rad;
    return nlohmann::ordered_json{deg.x(), deg.y(), deg.z()};
  };
  const auto& sigma_rad = run.refined->extrinsics_sigma_rad;
  summary["refined_extrinsics_error_deg"] = inDegrees(run.refined->extrinsics_error_rad);
  summary["refined_extrinsics_sigma_deg"] = nullptr;
  if (sigma_rad) summary["refined_extrinsics_sigma_deg"] = inDegrees(*sigma_rad);
  summary["refine_seconds"] = run.refined->seconds;
}

}  // namespace ardrone_vslam
