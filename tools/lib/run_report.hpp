// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "offline_run.hpp"
#include "trajectory.hpp"

namespace ardrone_vslam {

/// What a run was made of; goes into every summary.
struct RunLabel {
  std::string sequence;
  std::string profile;  ///< "recorded": the bag's or folder's own odometry
  std::uint64_t seed = 0;
  std::string estimator;
};

/// A run's trajectories at the images' stamps and its errors. Without truth only fused and observer
/// are filled.
struct RunEvaluation {
  Trajectory fused;
  Trajectory observer;  ///< T_odom_base; map equals odom at the start
  Trajectory truth;
  std::vector<double> fused_error_m;
  std::vector<double> observer_error_m;
  std::vector<double> camera_error_m;  ///< of camera_position_map; NaN where there was none
  std::vector<double> nees;
};

RunEvaluation evaluate(const RunResult& run, const Trajectory& truth);

/// The numbers of one run (docs/data_path.md explains each). What does not exist is null.
nlohmann::ordered_json summaryOf(const RunResult& run, const RunEvaluation& evaluation,
                                 const RunLabel& label);

/// Median and worst over the summaries of several seeds, for every numeric entry where larger is
/// worse.
nlohmann::ordered_json summaryOfSeeds(const std::vector<nlohmann::ordered_json>& summaries);

/// Writes observer.tum, fused.tum, truth.tum (if known), frames.csv, landmarks.csv and summary.json
/// into the folder, which is made. @throws std::runtime_error naming the file that cannot be
/// written
void writeRun(const std::string& folder, const RunResult& run, const RunEvaluation& evaluation,
              const nlohmann::ordered_json& summary);

/// Writes text to a file. @throws std::runtime_error naming the file
void writeText(const std::string& path, const std::string& text);

}  // namespace ardrone_vslam
