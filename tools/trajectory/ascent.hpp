// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ardrone_vslam {

enum class Ascent { kStrict, kMayRepeat };

/// Indices of the longest sub-sequence of stamps that ascends: what a single stamp far ahead, or
/// far back, does not take along. Patience sorting, O(n log n).
std::vector<std::size_t> longestAscent(const std::vector<std::int64_t>& stamps_ns, Ascent kind);

/// Leaves of `items` those at the indices, which ascend.
template <class Item>
void keepAt(const std::vector<std::size_t>& indices, std::vector<Item>& items) {
  std::vector<Item> kept;
  kept.reserve(indices.size());
  for (const std::size_t i : indices) kept.push_back(items[i]);
  items.swap(kept);
}

/// Leaves of `items`, which have a stamp_ns each, the longest ascent. @return how many went
template <class Item>
std::size_t keepAscent(Ascent kind, std::vector<Item>& items) {
  const std::size_t before = items.size();
  std::vector<std::int64_t> stamps_ns;
  stamps_ns.reserve(before);
  for (const Item& item : items) stamps_ns.push_back(item.stamp_ns);
  keepAt(longestAscent(stamps_ns, kind), items);
  return before - items.size();
}

}  // namespace ardrone_vslam
