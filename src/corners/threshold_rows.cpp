// SPDX-License-Identifier: BSD-3-Clause
#include "corners/threshold_rows.hpp"

#include <algorithm>

namespace ardrone_vslam {

void ThresholdRows::begin(const CornerCells& cells, const CornerThresholds& thresholds,
                          Reach reach) {
  cells_ = &cells;
  thresholds_ = &thresholds;
  reach_px_ = reach == Reach::kCellsBeside ? 1 : 0;
  first_cell_row_ = last_cell_row_ = -1;
  of_cell_.resize(static_cast<std::size_t>(cells.columns()));
  row_.resize(static_cast<std::size_t>(cells.columnBegin(cells.columns())));
}

const std::uint8_t* ThresholdRows::at(int y_px) {
  const int first = cells_->rowAt(y_px - reach_px_);
  const int last = cells_->rowAt(y_px + reach_px_);
  if (first != first_cell_row_ || last != last_cell_row_) fill(first, last);
  return row_.data();
}

void ThresholdRows::fill(int first_cell_row, int last_cell_row) {
  first_cell_row_ = first_cell_row;
  last_cell_row_ = last_cell_row;
  const int columns = cells_->columns();
  const auto threshold = [&](int column) -> std::uint8_t& {
    return of_cell_[static_cast<std::size_t>(column)];
  };
  for (int column = 0; column < columns; ++column) {
    int lowest = thresholds_->at(first_cell_row * columns + column);
    for (int row = first_cell_row + 1; row <= last_cell_row; ++row)
      lowest = std::min(lowest, thresholds_->at(row * columns + column));
    threshold(column) = static_cast<std::uint8_t>(lowest);
    std::fill(row_.begin() + cells_->columnBegin(column),
              row_.begin() + cells_->columnBegin(column + 1), threshold(column));
  }
  for (int column = 1; column < columns; ++column) {
    const int border_px = cells_->columnBegin(column);
    const std::uint8_t lowest = std::min(threshold(column - 1), threshold(column));
    for (int x = border_px - reach_px_; x < border_px + reach_px_; ++x) {
      std::uint8_t& entry = row_[static_cast<std::size_t>(x)];
      entry = std::min(entry, lowest);
    }
  }
}

}  // namespace ardrone_vslam
