// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

namespace ardrone_vslam::quality {
std::string toMarkdown(const QualityResults&) {
  return "";
}
}  // namespace ardrone_vslam::quality
