// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "freak/freak_pattern.hpp"

/// Which of the pattern's fields are compared with each other.
namespace ardrone_vslam {

/// Pairs that vote for the orientation, weighed by where they lie.
/// @param fields  all of scale 0, unturned
kernels::FreakOrientationPairs orientationPairsOf(const FreakField* fields);

/// The pairs that the descriptor's bits say which is the brighter of.
kernels::FreakComparisons selectedComparisons();

}  // namespace ardrone_vslam
