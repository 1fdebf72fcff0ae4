// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace ardrone_vslam {

/// Makes room for `count` elements and an eighth more, where push_back() and resize() would double
/// the room: an element is copied eight times at most in the mean, and an eighth stays empty.
template <class T>
void growByAnEighth(std::vector<T>& values, std::size_t count) {
  constexpr std::size_t kFew = 4;
  if (count > values.capacity()) values.reserve(count + count / 8 + kFew);
}
/// push_back() by that rule.
template <class T>
void appendTightly(std::vector<T>& values, T value) {
  growByAnEighth(values, values.size() + 1);
  values.push_back(value);
}

}  // namespace ardrone_vslam
