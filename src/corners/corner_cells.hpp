// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"

namespace ardrone_vslam {

/// The cells that share the corner budget: columns and rows of nearly equal size, numbered row by
/// row.
class CornerCells {
 public:
  /// @param cell_size_px  wished side; the image's width and height are divided into a whole
  ///   number of cells
  void reset(int width_px, int height_px, int cell_size_px);

  int count() const { return columns_ * rows_; }
  int columns() const { return columns_; }
  /// First column of pixels; of the column after the last: the image's width.
  int columnBegin(int column) const { return column_begin_[static_cast<std::size_t>(column)]; }
  int rowAt(int y_px) const { return cell_row_[static_cast<std::size_t>(y_px)]; }
  int columnAt(int x_px) const { return cell_column_[static_cast<std::size_t>(x_px)]; }
  int cellAt(int x_px, int y_px) const { return rowAt(y_px) * columns_ + columnAt(x_px); }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint16_t> cell_column_;  ///< for each pixel column
  std::vector<std::uint16_t> cell_row_;     ///< for each pixel row
  std::vector<int> column_begin_;
};

/// Corners grouped by cell, in each cell the strongest first; of equal ones the first in raster
/// order.
class CornersByCell {
 public:
  /// Makes room for so many corners, so that no image with no more of them allocates.
  void reserve(std::size_t corners);

  /// @param corners  in raster order; kept by reference until the next call
  void group(const std::vector<Corner>& corners, const CornerCells& cells);

  int cellCount() const { return static_cast<int>(begin_.size()) - 1; }
  int count(int cell) const;
  /// The cell's corner of this rank, 0 the strongest. @pre rank < count(cell)
  const Corner& corner(int cell, int rank) const;

  /// @return the largest number, at most `budget`, such that the cells can all give that many
  ///   corners, or all they have if they have fewer, within the budget
  int equalLevel(int budget) const;

  /// Gives every cell an equal share of the budget and what some cells leave over in equal parts
  /// to those that have more, again and again; the last few, fewer than there are such cells, go
  /// to the strongest next corners.
  /// @param selected  receives at most `budget` corners in raster order; has room for one more
  ///   meanwhile
  void select(int budget, std::vector<Corner>& selected);

 private:
  int taken(int level) const;

  const std::vector<Corner>* corners_ = nullptr;
  std::vector<int> begin_;     ///< first entry of each cell in `order_`, and the end of the last
  std::vector<int> by_score_;  ///< indices of the corners, the strongest first
  std::vector<int>
      order_;  ///< indices of the corners, grouped by cell, in each the strongest first
  std::vector<int> next_;
  std::vector<std::uint8_t> keep_;
};

}  // namespace ardrone_vslam
