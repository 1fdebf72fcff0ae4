// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kernels/fast/fast_kernels.hpp"

// What is done with the scores of whole rows; V as in fast_lanes.hpp.
namespace ardrone_vslam::kernels {

/// Takes each column once though groups may overlap. Groups of one column, from rows too short for
/// a block, will do: what follows them is looked at too.
template <class V>
class FreshLanes {
 public:
  FreshLanes() {
    V::store(window_, V::broadcast(0));
    V::store(window_ + V::kLanes, V::broadcast(0xFFFFFFFFU));
  }

  /// @return 255 in the lanes that no group before had
  typename V::Bytes next(int x) {
    const int overlap = done_px_ > x ? done_px_ - x : 0;
    done_px_ = x + V::kLanes;
    return V::load(window_ + V::kLanes - overlap);
  }

 private:
  std::uint8_t window_[2 * V::kLanes];
  int done_px_ = 0;
};

/// See fastMaximaScalar.
template <class V>
int fastMaximaLanes(const FastNeighbours& rows, std::uint16_t* columns) {
  const auto may_exceed = V::broadcast(rows.later_may_equal ? 0x01010101U : 0U);
  FreshLanes<V> fresh;
  int count = 0;
  for (int i = 0; i < rows.group_count; ++i) {
    const int x = rows.groups[i];
    const std::uint8_t* a = rows.above + x;
    const std::uint8_t* c = rows.row + x;
    const std::uint8_t* b = rows.below + x;
    const auto earlier =
        V::max(V::max(V::load(a - 1), V::load(a)), V::max(V::load(a + 1), V::load(c - 1)));
    const auto later =
        V::max(V::max(V::load(c + 1), V::load(b - 1)), V::max(V::load(b), V::load(b + 1)));
    const auto highest = V::max(earlier, V::subtract(later, may_exceed));
    const auto maxima = V::subtract(V::load(c), highest);
    count = V::append(V::min(maxima, fresh.next(x)), x, columns, count);
  }
  return count;
}

/// See fastListScalar.
template <class V>
int fastListLanes(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                  std::uint16_t* columns) {
  FreshLanes<V> fresh;
  int count = 0;
  for (int i = 0; i < group_count; ++i) {
    const int x = groups[i];
    count = V::append(V::min(V::load(scores + x), fresh.next(x)), x, columns, count);
  }
  return count;
}

}  // namespace ardrone_vslam::kernels
