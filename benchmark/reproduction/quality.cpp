// SPDX-License-Identifier: BSD-3-Clause
#include "measurements.hpp"
#include "motions.hpp"
#include "report.hpp"
#include "source_images.hpp"
#include "sweeps.hpp"

namespace ardrone_vslam::reproduction {

nlohmann::json measureQuality(bool quick) {
  constexpr int kBudget = 500, kFrames = 300, kQuickFrames = 12;
  quality::QualityResults results;
  results.budget = kBudget;
  results.motion_frames = quick ? kQuickFrames : kFrames;
  const quality::SourceImages source = quality::sweepImages(quick);
  results.sweep_images = source.what;
  results.sweeps = quality::runSweeps(source, kBudget, quick);
  auto charts = quality::runMotions(results.motion_frames, kBudget);
  results.motions = std::move(charts.motions);
  results.passes = std::move(charts.passes);
  return nlohmann::json::parse(quality::toJson(results));
}

}  // namespace ardrone_vslam::reproduction
