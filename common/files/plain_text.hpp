// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

namespace ardrone_vslam {

/// What keeps a yaml file from being a text; empty when nothing does. yaml-cpp takes zeros at the
/// beginning for another encoding and a control character for the end, and leaves out what follows
/// without a word.
inline std::string faultOfText(const std::string& text) {
  const auto is_control = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7f;
  };
  const auto found = std::find_if(text.begin(), text.end(), is_control);
  if (found == text.end()) return "";
  return "byte " + std::to_string(found - text.begin()) +
         " is of no text: it is damaged, or no UTF-8; use another copy, or save it as UTF-8";
}

}  // namespace ardrone_vslam
