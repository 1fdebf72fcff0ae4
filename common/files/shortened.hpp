// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// What a message shows of a user's text: its beginning, whatever its length.
inline std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 80;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace ardrone_vslam
