// SPDX-License-Identifier: BSD-3-Clause
#include "summary/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "summary/cost_summary.hpp"
#include "summary/flight_summary.hpp"
#include "summary/map_summary.hpp"
#include "summary/refined_summary.hpp"
#include "summary/run_words.hpp"
#include "summary/track_summary.hpp"
#include "trajectory/metrics.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class Value>
std::vector<double> collect(const RunResult& run, Value&& value) {
  std::vector<double> values;
  values.reserve(run.frames.size());
  for (const RunFrame& frame : run.frames) values.push_back(static_cast<double>(value(frame)));
  return values;
}

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> kept;
  std::copy_if(values.begin(), values.end(), std::back_inserter(kept),
               [](double value) { return std::isfinite(value); });
  return kept;
}

void addCameraErrors(const RunEvaluation& e, bool known, Json& summary) {
  const std::vector<double> camera = finite(e.camera_error_m);
  const ErrorSummary camera_summary = summarise(camera);
  const bool fixed = known && !camera.empty();
  summary["camera_frames"] = camera.size();
  summary["camera_error_mean_m"] = fixed ? orNull(camera_summary.mean_m) : Json(nullptr);
  summary["camera_error_max_m"] = fixed ? orNull(camera_summary.max_m) : Json(nullptr);
}

void addNees(const RunEvaluation& e, Json& summary) {
  const std::vector<double> nees_values = finite(e.nees);
  summary["nees_mean"] =
      nees_values.empty() ? Json(nullptr) : orNull(summarise(nees_values).mean_m);
  const auto outside = std::count_if(nees_values.begin(), nees_values.end(),
                                     [](double n) { return n > kNees3Sigma; });
  summary["outside_3_sigma"] =
      nees_values.empty()
          ? Json(nullptr)
          : Json(static_cast<double>(outside) / static_cast<double>(nees_values.size()));
}

/// None in a loaded map: its scale is that of the odometry it was made with.
void addScaleRemoved(const RunResult& run, const RunEvaluation& e, bool drifts, Json& summary) {
  for (const char* key : {"odometry_ate_rmse_scale_removed_m", "fused_ate_rmse_scale_removed_m",
                          "ratio_scale_removed"})
    summary[key] = nullptr;
  if (e.truth.empty() || run.is_in_loaded_map) return;
  const Trajectory truth = scaled(e.truth, run.scale_error);
  const double odometry_m = summarise(positionErrors_m(e.odometry_at_truth, truth)).rmse_m;
  const double fused_m = summarise(positionErrors_m(e.fused_at_truth, truth)).rmse_m;
  summary["odometry_ate_rmse_scale_removed_m"] = orNull(odometry_m);
  summary["fused_ate_rmse_scale_removed_m"] = orNull(fused_m);
  if (drifts) summary["ratio_scale_removed"] = orNull(fused_m / odometry_m);
}

void addErrors(const RunResult& run, const RunEvaluation& e, const RunLabel& label, Json& summary) {
  const ErrorSummary fused = summarise(finite(e.fused_error_m));
  const ErrorSummary odometry = summarise(finite(e.odometry_error_m));
  const bool known = !e.truth.empty();
  const auto ifKnown = [known](double value) { return known ? orNull(value) : Json(nullptr); };
  const bool drifts = label.profile != "truth" && odometry.rmse_m > 0;
  summary["odometry_ate_rmse_m"] = ifKnown(odometry.rmse_m);
  summary["fused_ate_rmse_m"] = ifKnown(fused.rmse_m);
  summary["fused_error_mean_m"] = ifKnown(fused.mean_m);
  summary["fused_error_max_m"] = ifKnown(fused.max_m);
  summary["ratio"] = drifts ? ifKnown(fused.rmse_m / odometry.rmse_m) : Json(nullptr);

  addScaleRemoved(run, e, drifts, summary);
  summary["fused_ate_rmse_aligned_m"] = ifKnown(alignedRmse_m(e.fused_at_truth, e.truth));
  summary["odometry_scale_error"] = run.scale_error;
  addRefinement(run, e.truth, summary);

  summary["fused_error_last_m"] =
      known && !e.fused_error_m.empty() ? orNull(e.fused_error_m.back()) : Json(nullptr);
  summary["odometry_error_last_m"] =
      known && !e.odometry_error_m.empty() ? orNull(e.odometry_error_m.back()) : Json(nullptr);
  const auto t_rel = known ? translationError_percent(e.fused_at_truth, e.truth) : std::nullopt;
  const auto odometry_t_rel =
      known ? translationError_percent(e.odometry_at_truth, e.truth) : std::nullopt;
  summary["t_rel_percent"] = t_rel ? Json(*t_rel) : Json(nullptr);
  summary["odometry_t_rel_percent"] = odometry_t_rel ? Json(*odometry_t_rel) : Json(nullptr);

  addCameraErrors(e, known, summary);
  addNees(e, summary);
  summary["frames_without_truth"] = e.frames_without_truth;
  summary["frames_error_not_finite"] = e.frames_error_not_finite;
}

void addScale(const RunResult& run, Json& summary) {
  const FrameResult last = run.frames.empty() ? FrameResult{} : run.frames.back().result;
  const bool is_estimated = last.scale_sigma > 0;
  const auto count = [&run](HeightOutcome outcome) {
    return std::count_if(run.frames.begin(), run.frames.end(), [outcome](const RunFrame& frame) {
      return frame.result.height == outcome;
    });
  };
  summary["fused_scale_error"] = is_estimated ? orNull(last.scale_error) : Json(nullptr);
  summary["fused_scale_sigma"] = is_estimated ? orNull(last.scale_sigma) : Json(nullptr);
  // More is better: isWorseWhenLarger names it, as every count of which that is so.
  summary["heights_used"] = count(HeightOutcome::kApplied);
  summary["heights_rejected"] = count(HeightOutcome::kRejected);
  summary["floors"] = count(HeightOutcome::kNewFloor);
  summary["heights_missing"] = run.heights_missing;
  summary["heights_tilted"] = run.heights_tilted;
  summary["ranges_refused"] = run.ranges_refused;
}

/// Null without a stamp (0).
Json secondsAfterFirst(const RunResult& run, std::int64_t ns) {
  return ns == 0 ? Json()
                 : Json(1e-9 * static_cast<double>(ns - run.frames.front().result.stamp_ns));
}

}  // namespace

bool isNotFinite(const Landmark& landmark) {
  return !landmark.position_map.allFinite() ||
         !std::isfinite(landmark.sigma_m + landmark.depth_sigma_m);
}

RunEvaluation evaluate(const RunResult& run, const Trajectory& truth) {
  constexpr std::int64_t kLongestTruthGap_ns = 1'000'000'000;
  RunEvaluation e;
  e.found_frame = static_cast<std::size_t>(countSearching(run));
  const Eigen::Isometry3d T_map_odom = odometryFrameWhenFound(run, e.found_frame);
  for (const RunFrame& frame : run.frames) {
    const FrameResult& r = frame.result;
    const std::int64_t exposed_ns = frame.exposed_ns();
    const StampedPose fused{exposed_ns, r.T_map_base};
    const StampedPose odometry{exposed_ns, T_map_odom * r.T_odom_base};
    e.fused.append(fused);
    e.odometry.append(odometry);
    double camera_error = kNotKnown;
    double fused_nees = kNotKnown;
    double fused_error = kNotKnown;
    double odometry_error = kNotKnown;
    if (r.state == SlamState::kSearchingMap) {  // nowhere
    } else if (truth.covers(exposed_ns, kLongestTruthGap_ns)) {
      const Eigen::Isometry3d T_map_base = truth.at(exposed_ns);
      e.truth.append({exposed_ns, T_map_base});
      e.fused_at_truth.append(fused);
      e.odometry_at_truth.append(odometry);
      const Eigen::Vector3d position = T_map_base.translation();
      const Eigen::Vector3d error = r.T_map_base.translation() - position;
      fused_error = error.norm();
      odometry_error = (odometry.T_frame_body.translation() - position).norm();
      fused_nees = nees(error, r.covariance.topLeftCorner<3, 3>());
      if (!std::isfinite(fused_error + odometry_error)) ++e.frames_error_not_finite;
      if (r.landmark_position_map) camera_error = (*r.landmark_position_map - position).norm();
    } else {
      ++e.frames_without_truth;
    }
    e.fused_error_m.push_back(fused_error);
    e.odometry_error_m.push_back(odometry_error);
    e.camera_error_m.push_back(camera_error);
    e.nees.push_back(fused_nees);
  }
  return e;
}

Json summaryOf(const RunResult& run, const RunEvaluation& evaluation, const RunLabel& label) {
  Json summary = {{"sequence", label.sequence}};
  summary["frames"] = run.frames.size();
  addFlight(run, evaluation.truth.empty() ? evaluation.odometry : evaluation.truth, summary);
  summary["frames_dropped_slow"] = run.frames_dropped_slow;
  summary["camera_changes"] = run.camera_changes;
  summary["frames_without_odometry"] = run.frames_without_odometry;
  summary["odometry_states_refused"] = run.odometry_states_refused;
  const TimeOffset& offset = run.time_offset;
  const bool is_known = offset.state == TimeOffsetState::kKnown;
  summary["image_time_offset_s"] = run.image_time_offset_s;
  summary["image_time_offset_found_s"] = secondsAfterFirst(run, run.time_offset_found_ns);
  summary["image_time_offset_estimate_s"] = is_known ? Json(offset.offset_s) : Json();
  summary["image_time_offset_sigma_s"] = is_known ? Json(offset.sigma_s) : Json();
  summary["image_time_offset_unknown"] = is_known ? Json() : Json(explain(offset.state));
  summary["setup_fault"] = nameOf(run.setup.fault);
  summary["setup_confirmed"] = run.setup.is_confirmed;
  summary["setup_fault_found_s"] = secondsAfterFirst(run, run.setup_fault_ns);
  addMap(run, evaluation.found_frame, summary);
  summary["odometry_steps"] =
      std::count_if(run.frames.begin(), run.frames.end(),
                    [](const RunFrame& f) { return f.result.odometry_step_m > 0; });
  summary["revisits"] = std::count_if(run.frames.begin(), run.frames.end(),
                                      [](const RunFrame& f) { return f.result.revisit_m > 0; });
  summary["odometry_froze"] = run.odometry_froze;
  summary["frames_distrusted"] = countDistrusted(run);
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i)
    summary["odometry_faults"][EnumNames<OdometryFault>::kNames[i]] = run.odometry_faults[i];
  summary["profile"] = label.profile;
  summary["seed"] = label.seed ? Json(*label.seed) : Json(nullptr);
  summary["estimator"] = label.estimator;
  addErrors(run, evaluation, label, summary);
  const auto matches = collect(run, [](const RunFrame& f) { return f.result.landmark_matches; });
  summary["landmark_matches_median"] = quantile(matches, 0.5);
  summary["landmarks"] = run.landmarks.size();
  summary["landmarks_not_finite"] =
      std::count_if(run.landmarks.begin(), run.landmarks.end(), isNotFinite);
  addTracks(run, summary);
  addLearnedNoise(run, summary);
  addScale(run, summary);
  addCost(run, summary);
  summary["verdict"] = verdictOf(summary);
  return summary;
}

}  // namespace ardrone_vslam
