// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_thresholds.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

constexpr int kMostShares = 4;  ///< so that one textured cell alone does not try to fill the budget

}  // namespace

void CornerThresholds::reset(const CornerDetectorConfig& config, int cell_count) {
  config_ = config;
  share_ = std::max(1, config.features_per_frame / cell_count);
  threshold_.assign(static_cast<std::size_t>(cell_count),
                    static_cast<std::uint8_t>(config.threshold));
}

void CornerThresholds::adapt(const CornersByCell& corners) {
  if (!config_.adapt_threshold) return;
  const int level = corners.equalLevel(config_.features_per_frame);
  const int wanted = std::clamp(level, share_, kMostShares * share_);
  const int target = (3 * wanted + 1) / 2;
  for (int cell = 0; cell < corners.cellCount(); ++cell) {
    const int count = corners.count(cell);
    int threshold = at(cell);
    if (count > 2 * wanted) {
      threshold = corners.corner(cell, target - 1).score;
    } else if (count < wanted) {
      threshold -= std::max(1, threshold / (2 * count < wanted ? 4 : 8));
    }
    threshold = std::clamp(threshold, config_.threshold_min, config_.threshold_max);
    threshold_[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(threshold);
  }
}

}  // namespace ardrone_vslam
