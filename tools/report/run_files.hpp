// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "summary/run_report.hpp"

namespace ardrone_vslam {

/// All that a run writes.
constexpr std::array<const char*, 7> kRunFiles{"odometry.tum", "fused.tum",  "refined.tum",
                                               "truth.tum",    "frames.csv", "landmarks.csv",
                                               "summary.json"};

/// What scripts/evaluate writes beside them when it is asked for a report of the folder.
constexpr std::array<const char*, 2> kPageFiles{"report.html", "evaluation.json"};

/// Where the files of one of several seeds go.
/// Made before the work, so that a folder that cannot be written does not cost a run.
/// @throws std::runtime_error
void makeRunFolder(const std::string& folder);

std::string seedFolder(const std::string& folder, std::uint64_t seed);

/// Writes kRunFiles (truth.tum if it is known) into the folder, which is made. @throws
/// std::runtime_error naming the file that cannot be written
void writeRun(const std::string& folder, const RunResult& run, const RunEvaluation& evaluation,
              const nlohmann::ordered_json& summary);

}  // namespace ardrone_vslam
