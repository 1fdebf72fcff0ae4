// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/ascent.hpp"

#include <algorithm>
#include <iterator>

namespace ardrone_vslam {

std::vector<std::size_t> longestAscent(const std::vector<std::int64_t>& stamps_ns, Ascent kind) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> ends;  // of the ascents of each length: the one that ends lowest
  std::vector<std::size_t> before(stamps_ns.size(), kNone);
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
    const auto isPassed = [&](std::size_t end) {
      return kind == Ascent::kStrict ? stamps_ns[end] < stamps_ns[i]
                                     : stamps_ns[end] <= stamps_ns[i];
    };
    const auto end = std::partition_point(ends.begin(), ends.end(), isPassed);
    if (end != ends.begin()) before[i] = *std::prev(end);
    if (end == ends.end()) {
      ends.push_back(i);
    } else {
      *end = i;
    }
  }
  std::vector<std::size_t> ascent;
  for (std::size_t i = ends.empty() ? kNone : ends.back(); i != kNone; i = before[i])
    ascent.push_back(i);
  std::reverse(ascent.begin(), ascent.end());
  return ascent;
}

}  // namespace ardrone_vslam
