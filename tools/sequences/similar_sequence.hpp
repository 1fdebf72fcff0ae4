// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "sequences/sequence.hpp"

namespace ardrone_vslam {

/// How a flight is made into a similar one that is as true: nothing but lengths, or left and right,
/// should change what comes of it.
struct Similarity {
  double scale = 1;  ///< the scene and the flight are so many times as large, at the same speed:
                     ///< positions, stamps and the camera's lever arm
  bool is_mirrored = false;  ///< images and truth, left to right
};

/// View of a sequence as a similar one. A recorded odometry and ranges are dropped.
/// @pre the scale is above 0
std::unique_ptr<Sequence> withSimilarity(std::unique_ptr<Sequence> sequence,
                                         const Similarity& similarity);

}  // namespace ardrone_vslam
