// SPDX-License-Identifier: BSD-3-Clause
#include "conversions/frame_names.hpp"

namespace ardrone_vslam {

std::string withTfPrefix(const std::string& prefix, const std::string& frame) {
  if (frame.empty()) return frame;
  if (frame.front() == '/') return frame.substr(1);
  const std::string bare = !prefix.empty() && prefix.front() == '/' ? prefix.substr(1) : prefix;
  if (bare.empty() || frame.compare(0, bare.size() + 1, bare + "/") == 0) return frame;
  return bare + "/" + frame;
}

}  // namespace ardrone_vslam
