// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ardrone_vslam {

/// Buckets the pixels of one image into square cells, for searches in windows. Buffers are kept
/// from frame to frame.
class PixelGrid {
 public:
  /// O(pixels + cells). Pixels outside the image count to the nearest cell.
  void build(const std::vector<Eigen::Vector2f>& pixels_px, int width_px, int height_px,
             float cell_px = 32.F) {
    cell_px_ = cell_px;
    columns_ = std::max(1, static_cast<int>(std::ceil(static_cast<float>(width_px) / cell_px)));
    rows_ = std::max(1, static_cast<int>(std::ceil(static_cast<float>(height_px) / cell_px)));
    first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const auto& pixel : pixels_px) ++first_[cellOf(pixel) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    indices_.resize(pixels_px.size());
    fill_.assign(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < pixels_px.size(); ++i) {
      indices_[static_cast<std::size_t>(fill_[cellOf(pixels_px[i])]++)] = static_cast<int>(i);
    }
  }

  /// Calls visit(index) for every pixel in the cells that touch the square of half side `radius_px`
  /// around the centre: a superset of the window, in a fixed order. The caller tests the exact
  /// distance.
  template <class Visitor>
  void visit(const Eigen::Vector2f& centre_px, float radius_px, Visitor&& visitor) const {
    const int left = column(centre_px.x() - radius_px);
    const int right = column(centre_px.x() + radius_px);
    const int top = row(centre_px.y() - radius_px);
    const int bottom = row(centre_px.y() + radius_px);
    for (int r = top; r <= bottom; ++r) {
      const auto begin =
          static_cast<std::size_t>(first_[static_cast<std::size_t>(r * columns_ + left)]);
      const auto end =
          static_cast<std::size_t>(first_[static_cast<std::size_t>(r * columns_ + right) + 1]);
      for (std::size_t i = begin; i < end; ++i) visitor(indices_[i]);
    }
  }

 private:
  /// Clamps before the conversion, so that no float (nor NaN, which goes to 0) is out of an int's
  /// range.
  static int cell(float position, int cells) {
    return static_cast<int>(std::min(std::max(0.F, position), static_cast<float>(cells - 1)));
  }
  int column(float x_px) const { return cell(x_px / cell_px_, columns_); }
  int row(float y_px) const { return cell(y_px / cell_px_, rows_); }
  std::size_t cellOf(const Eigen::Vector2f& p) const {
    return static_cast<std::size_t>(row(p.y()) * columns_ + column(p.x()));
  }

  float cell_px_ = 32.F;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> first_;  // of each cell, into indices_
  std::vector<int> fill_;
  std::vector<int> indices_;
};

}  // namespace ardrone_vslam
