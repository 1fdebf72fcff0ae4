// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "corners/corner_cells.hpp"
#include "corners/corner_thresholds.hpp"

namespace ardrone_vslam {

/// The cells' thresholds as the kernels read them: one for each pixel of a row.
class ThresholdRows {
 public:
  /// - kOwnCell: the threshold of the pixel's cell.
  /// - kCellsBeside: the lowest of those that the pixel and its 8 neighbours have. So every pixel
  ///   that could be higher than a corner beside it is found, also where it lies in a cell of a
  ///   higher threshold.
  enum class Reach { kOwnCell, kCellsBeside };

  /// Takes the thresholds for a new image. `cells` and `thresholds` must outlive the calls of at().
  void begin(const CornerCells& cells, const CornerThresholds& thresholds, Reach reach);

  /// @param y_px  rows must come in ascending order, which is what makes most of them free; neither
  ///   the first nor the last of the image
  /// @return the thresholds of all columns, until the next call
  const std::uint8_t* at(int y_px);

 private:
  void fill(int first_cell_row, int last_cell_row);

  const CornerCells* cells_ = nullptr;
  const CornerThresholds* thresholds_ = nullptr;
  int reach_px_ = 0;
  int first_cell_row_ = -1;  ///< of the cells that `row_` is made of
  int last_cell_row_ = -1;
  std::vector<std::uint8_t> of_cell_;  ///< for each column of cells
  std::vector<std::uint8_t> row_;      ///< for each column of pixels
};

}  // namespace ardrone_vslam
