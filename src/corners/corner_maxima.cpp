// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_maxima.hpp"

#include <algorithm>

namespace ardrone_vslam {

void CornerMaxima::begin(int width_px, Ties ties, std::vector<Corner>& maxima) {
  const auto width = static_cast<std::size_t>(width_px);
  for (Row& row : rows_) {
    row.scores.assign(width + kernels::kScorePadding, 0);
    row.groups.resize(width);
    row.group_count = 0;
  }
  columns_.resize(width + kernels::kMaximaPadding);
  later_may_equal_ = ties == Ties::kEarlierIsHigher;
  maxima_ = &maxima;
  maxima_->clear();
}

kernels::FastScores CornerMaxima::nextRow() {
  return {rows_[next_].scores.data(), rows_[next_].groups.data()};
}

void CornerMaxima::endRow(int y_px, int group_count) {
  Row& below = rows_[next_];
  const Row& row = rows_[(next_ + 2) % 3];
  Row& above = rows_[(next_ + 1) % 3];
  below.group_count = group_count;
  const int count =
      kernels_.fast_maxima({above.scores.data(), row.scores.data(), below.scores.data(),
                            row.groups.data(), row.group_count, later_may_equal_},
                           columns_.data());
  for (const auto* x = columns_.data(); x != columns_.data() + count; ++x) {
    maxima_->push_back(
        {static_cast<std::int16_t>(*x), static_cast<std::int16_t>(y_px - 1), row.scores[*x]});
  }
  if (above.group_count != 0) std::fill(above.scores.begin(), above.scores.end(), std::uint8_t{0});
  above.group_count = 0;
  next_ = (next_ + 1) % 3;
}

}  // namespace ardrone_vslam
