// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/offline_run.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// What a run was made of; goes into every summary.
struct RunLabel {
  std::string sequence;
  std::string profile;                ///< "recorded": the input's own odometry
  std::optional<std::uint64_t> seed;  ///< nothing for a real odometry
  std::string estimator;
};

/// A run's trajectories at the exposures (stamps plus image_time_offset_s) and its errors: an entry
/// for each frame, NaN where there is no truth.
struct RunEvaluation {
  Trajectory fused;
  Trajectory odometry;        ///< map equals odom at the start, or where a loaded map was found
  Trajectory truth;           ///< at the frames that it covers
  Trajectory fused_at_truth;  ///< at the same frames
  Trajectory odometry_at_truth;
  std::size_t found_frame = 0;   ///< the errors leave out those before: a loaded map was searched
  int frames_without_truth = 0;  ///< before, after, or in gaps of the truth of more than a second
  /// The truth is known, but fused or odometry error is not finite; left out of all means.
  int frames_error_not_finite = 0;
  std::vector<double> fused_error_m;
  std::vector<double> odometry_error_m;
  std::vector<double> camera_error_m;  ///< of landmark_position_map; NaN where there was none
  std::vector<double> nees;
};

/// Such landmarks are counted in the summary and left out of landmarks.csv.
bool isNotFinite(const Landmark& landmark);

RunEvaluation evaluate(const RunResult& run, const Trajectory& truth);

/// The numbers of one run (docs/summary_keys.md explains each). What does not exist is null.
nlohmann::ordered_json summaryOf(const RunResult& run, const RunEvaluation& evaluation,
                                 const RunLabel& label);

}  // namespace ardrone_vslam
