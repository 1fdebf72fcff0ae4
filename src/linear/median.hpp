// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ardrone_vslam {

/// The upper one of the two in the middle where the count is even. Linear in the count.
/// @param values  not empty; their order changes
template <class T>
T medianOf(std::vector<T>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace ardrone_vslam
