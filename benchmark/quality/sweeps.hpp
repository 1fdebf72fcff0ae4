// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "chart.hpp"
#include "source_images.hpp"

namespace ardrone_vslam::quality {

/// Each picture against itself turned, scaled and blurred (thesis figures 4.5-4.7); means over the
/// pictures.
/// @param quick  fewer steps
std::vector<Chart> runSweeps(const SourceImages& source, int budget, bool quick);

}  // namespace ardrone_vslam::quality
