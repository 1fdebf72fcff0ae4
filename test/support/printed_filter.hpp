// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "thesis/thesis_filter.hpp"

namespace ardrone_vslam::test {

/// No floors, no gate that matters, landmarks independent: the printed equations alone.
inline ThesisFilterConfig printedOnly() {
  ThesisFilterConfig config;
  config.min_landmarks = 1;
  return asPrinted(config);
}

}  // namespace ardrone_vslam::test
