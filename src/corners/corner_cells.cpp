// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_cells.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

namespace ardrone_vslam {
namespace {

constexpr std::size_t kScores = 256;

/// Divides `size_px` pixels into parts of about `part_px`. @return the number of parts
int divide(int size_px, int part_px, std::vector<std::uint16_t>& part_of) {
  const int parts = std::max(1, (size_px + part_px / 2) / part_px);
  part_of.resize(static_cast<std::size_t>(size_px));
  for (int i = 0; i < size_px; ++i) {
    const auto part = static_cast<std::int64_t>(i) * parts / size_px;
    part_of[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(part);
  }
  return parts;
}

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

void CornerCells::reset(int width_px, int height_px, int cell_size_px) {
  columns_ = divide(width_px, cell_size_px, cell_column_);
  rows_ = divide(height_px, cell_size_px, cell_row_);
  column_begin_.assign(at(columns_ + 1), width_px);
  for (int x = width_px - 1; x >= 0; --x) column_begin_[at(columnAt(x))] = x;
}

void CornersByCell::reserve(std::size_t corners) {
  by_score_.reserve(corners);
  order_.reserve(corners);
  keep_.reserve(corners);
}

void CornersByCell::group(const std::vector<Corner>& corners, const CornerCells& cells) {
  corners_ = &corners;
  const int n = static_cast<int>(corners.size());
  begin_.assign(at(cells.count() + 1), 0);
  by_score_.resize(corners.size());
  order_.resize(corners.size());

  // Sorted by counting, which keeps equal ones in their order: by score, then by cell.
  std::array<int, kScores + 1> place{};
  for (const Corner& corner : corners) {
    ++place[kScores - corner.score];
    ++begin_[at(cells.cellAt(corner.x_px, corner.y_px) + 1)];
  }
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  for (int i = 0; i < n; ++i) by_score_[at(place[kScores - 1U - corners[at(i)].score]++)] = i;
  next_ = begin_;
  for (const int i : by_score_) {
    const Corner& corner = corners[at(i)];
    order_[at(next_[at(cells.cellAt(corner.x_px, corner.y_px))]++)] = i;
  }
}

int CornersByCell::count(int cell) const {
  return begin_[at(cell + 1)] - begin_[at(cell)];
}

const Corner& CornersByCell::corner(int cell, int rank) const {
  assert(rank >= 0 && rank < count(cell) && "rank beyond the cell's corners");
  return (*corners_)[at(order_[at(begin_[at(cell)] + rank)])];
}

/// Corners taken if every cell gives at most `level`.
int CornersByCell::taken(int level) const {
  int sum = 0;
  for (int cell = 0; cell < cellCount(); ++cell) sum += std::min(count(cell), level);
  return sum;
}

int CornersByCell::equalLevel(int budget) const {
  int low = 0;
  int high = budget + 1;  // taken(low) <= budget always, level `high` is not allowed or not needed
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (taken(middle) <= budget ? low : high) = middle;
  }
  return low;
}

void CornersByCell::select(int budget, std::vector<Corner>& selected) {
  const std::vector<Corner>& corners = *corners_;
  const int level = equalLevel(budget);
  keep_.assign(corners.size(), 0);
  next_.clear();
  for (int cell = 0; cell < cellCount(); ++cell) {
    const int begin = begin_[at(cell)];
    const int given = std::min(level, count(cell));
    for (int rank = 0; rank < given; ++rank) keep_[at(order_[at(begin + rank)])] = 1;
    if (given < count(cell)) next_.push_back(order_[at(begin + given)]);
  }
  std::sort(next_.begin(), next_.end(), [&](int a, int b) {
    const int score_a = corners[at(a)].score;
    const int score_b = corners[at(b)].score;
    return score_a != score_b ? score_a > score_b : a < b;
  });
  const int left = std::min(budget - taken(level), static_cast<int>(next_.size()));
  for (int i = 0; i < left; ++i) keep_[at(next_[at(i)])] = 1;

  // Appended to without a branch, one too many at the end.
  selected.resize(std::min(corners.size(), at(budget)) + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    selected[count] = corners[i];
    count += keep_[i];
  }
  selected.resize(count);
}

}  // namespace ardrone_vslam
