// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "match_metrics.hpp"

namespace ardrone_vslam::quality {

/// One method's results, one for each x of its chart.
struct Curve {
  std::string method;
  std::vector<PairMetrics> points;
};

/// What one experiment gave.
struct Chart {
  std::string name;
  std::string axis;  ///< what x is, with its unit
  std::vector<double> x;
  std::vector<Curve> curves;
};

/// Everything that was measured, and on what.
struct QualityResults {
  int budget = 0;  ///< features of an image
  std::string sweep_images;
  int motion_frames = 0;
  std::vector<Chart> sweeps;
  std::vector<Chart> graf;     ///< none or one
  std::vector<Chart> motions;  ///< all methods against the number of frames between two images
  std::vector<Chart> passes;   ///< ours against the sampling passes, without a budget
};

}  // namespace ardrone_vslam::quality
