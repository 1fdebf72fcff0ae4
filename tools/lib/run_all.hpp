// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "config_file.hpp"
#include "offline_run.hpp"
#include "run_observers.hpp"
#include "sequence.hpp"

namespace ardrone_vslam {

/// The sequence with each of the observers; the front end runs once for all.
/// @param threads  for decoding and for the observers; the results do not depend on it
std::vector<RunResult> runAll(Sequence& sequence, const PipelineConfig& config,
                              const std::vector<RunObserver>& observers, int threads,
                              const Progress& progress);

}  // namespace ardrone_vslam
