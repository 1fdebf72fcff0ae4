// SPDX-License-Identifier: BSD-3-Clause
#include "corner_maxima.hpp"

#include <algorithm>

namespace ardrone_vslam {

void CornerMaxima::begin(int width_px, Ties ties, std::vector<Corner>& maxima) {
  const auto width = static_cast<std::size_t>(width_px);
  for (Row& row : rows_) {
    clear(row);
    if (row.scores.size() < width) row.scores.resize(width, 0);
    if (row.columns.size() < width) row.columns.resize(width + kernels::kHitPadding);
  }
  later_may_equal_ = ties == Ties::kEarlierIsHigher ? 1 : 0;
  maxima_ = &maxima;
  maxima_->clear();
}

kernels::FastHits CornerMaxima::nextRow() {
  return {rows_[next_].columns.data(), rows_[next_].scores.data()};
}

void CornerMaxima::endRow(int y_px, int count) {
  Row& below = rows_[next_];
  Row& row = rows_[(next_ + 2) % 3];
  Row& above = rows_[(next_ + 1) % 3];
  below.count = count;
  keepMaxima(y_px - 1, above, row, below);
  clear(above);
  next_ = (next_ + 1) % 3;
}

/// Without branches: which corners are maxima is not predictable.
void CornerMaxima::keepMaxima(int y_px, const Row& above, const Row& row, const Row& below) {
  const std::size_t before = maxima_->size();
  maxima_->resize(before + static_cast<std::size_t>(row.count));
  Corner* const first = maxima_->data() + before;
  Corner* end = first;
  for (int i = 0; i < row.count; ++i) {
    const std::uint16_t x = row.columns[static_cast<std::size_t>(i)];
    const std::uint8_t* const a = above.scores.data() + x;
    const std::uint8_t* const c = row.scores.data() + x;
    const std::uint8_t* const b = below.scores.data() + x;
    const int earlier = std::max(std::max<int>(a[-1], a[0]), std::max<int>(a[1], c[-1]));
    const int later = std::max(std::max<int>(c[1], b[-1]), std::max<int>(b[0], b[1]));
    *end = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y_px), c[0]};
    end += c[0] > std::max(earlier, later - later_may_equal_) ? 1 : 0;
  }
  maxima_->resize(before + static_cast<std::size_t>(end - first));
}

void CornerMaxima::clear(Row& row) {
  for (int i = 0; i < row.count; ++i) row.scores[row.columns[static_cast<std::size_t>(i)]] = 0;
  row.count = 0;
}

}  // namespace ardrone_vslam
