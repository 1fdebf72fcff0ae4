// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "chart.hpp"

namespace ardrone_vslam::quality {

/// What the four motions gave (thesis figure 4.9).
struct MotionCharts {
  std::vector<Chart> motions;  ///< all methods at the budget, x: frames between the two images
  std::vector<Chart> passes;   ///< FAST at the tracker's default threshold, all corners, x: passes
};

/// Flies a 568x320 camera through the synthetic room at 30 images a second: in a circle, to and
/// fro, sideways, and turning on the spot.
/// @param frames  images of each motion
MotionCharts runMotions(int frames, int budget);

}  // namespace ardrone_vslam::quality
