// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "chart.hpp"

namespace ardrone_vslam::quality {

/// The first image of graf (a painted wall, Mikolajczyk et al. 2005) against the five others, which
/// look at it more and more from the side.
/// @param folder  img1.ppm .. img6.ppm and H1to2p .. H1to6p
/// @throws std::runtime_error naming the file that cannot be read
Chart runGraf(const std::string& folder, int budget);

}  // namespace ardrone_vslam::quality
