// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "thesis/thesis_filter.hpp"

namespace ardrone_vslam::test {

/// No floors, no gate that matters, landmarks independent: the printed equations alone.
inline ThesisFilterConfig printedOnly() {
  ThesisFilterConfig config;
  config.common_drift = false;
  config.min_landmarks = 1;
  config.fix_deviation_floor_m = 0;
  config.fix_angle_floor_deg = 0;
  config.gate_sigmas = 1e6;
  return config;
}

}  // namespace ardrone_vslam::test
