// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace ardrone_vslam {

/// A converted message, or what is wrong with it and what helps.
template <class T>
struct Checked {
  std::optional<T> value;
  std::string fault;  ///< empty exactly when there is a value
};

/// The parts as one string.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

template <class Numbers>
bool allFinite(const Numbers& numbers) {
  for (const auto number : numbers) {
    if (!std::isfinite(number)) return false;
  }
  return true;
}

}  // namespace ardrone_vslam
