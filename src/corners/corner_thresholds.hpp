// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "corners/corner_cells.hpp"
#include "corners/corner_detector.hpp"

namespace ardrone_vslam {

/// The threshold of every cell, adapted from image to image so that a shaded part of the image is
/// not starved (thesis figure 7.2) and a textured one does not flood the budget.
///
/// A cell's wanted number of corners is its equal share of the budget, or more, up to four shares,
/// where other cells leave theirs. A cell with more than twice that takes at once the threshold
/// that would have left one and a half times that: exactly known, as a score is the threshold up to
/// which a corner stays one. A cell with fewer goes down an eighth at a time, a quarter below half
/// of it. So low thresholds after dark images are undone by the first bright one.
class CornerThresholds {
 public:
  /// Starts all cells at `config.threshold`.
  void reset(const CornerDetectorConfig& config, int cell_count);

  int at(int cell) const { return threshold_[static_cast<std::size_t>(cell)]; }

  /// Chooses the thresholds for the next image; nothing changes if `config.adapt_threshold` is
  /// off.
  /// @param corners  all corners of this image after suppression, before the budget
  void adapt(const CornersByCell& corners);

 private:
  CornerDetectorConfig config_;
  int share_ = 1;  ///< corners of the budget for each cell
  std::vector<std::uint8_t> threshold_;
};

}  // namespace ardrone_vslam
