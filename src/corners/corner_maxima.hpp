// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "kernels/kernels.hpp"

namespace ardrone_vslam {

/// Keeps of an image's corners those that are higher than their 8 neighbours, while the rows are
/// scanned from the top: the scores of three rows are enough. Pixels that are no corners do not
/// count. Allocates only when an image is wider than all before.
class CornerMaxima {
 public:
  /// Which of two neighbours with equal score is the higher: the one earlier in raster order (row
  /// by row from the top left), or neither, so that both are dropped.
  enum class Ties { kEarlierIsHigher, kBothDropped };

  explicit CornerMaxima(const kernels::Kernels& kernels) : kernels_(kernels) {}

  /// Starts a new image.
  /// @param maxima  receives the corners kept, in raster order
  void begin(int width_px, Ties ties, std::vector<Corner>& maxima);

  /// Where the corners of the next row are to be put. No corner in the first and the last column.
  kernels::FastScores nextRow();

  /// Ends that row, and with it the search in the row above. After the image's last row with
  /// corners one without any must follow.
  /// @param group_count  what the scan of the row returned
  void endRow(int y_px, int group_count);

 private:
  struct Row {
    std::vector<std::uint8_t> scores;   ///< 0 where there is no corner
    std::vector<std::uint16_t> groups;  ///< columns
    int group_count = 0;
  };

  const kernels::Kernels kernels_;
  std::array<Row, 3> rows_;
  std::size_t next_ = 0;  ///< of rows_
  bool later_may_equal_ = false;
  std::vector<std::uint16_t> columns_;  ///< of one row's maxima
  std::vector<Corner>* maxima_ = nullptr;
};

}  // namespace ardrone_vslam
