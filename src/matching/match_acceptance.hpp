// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/slam_config.hpp"

namespace ardrone_vslam {

/// Stands for the distance of a candidate that does not exist; larger than any distance.
constexpr int kNoDistance_bits = 513;

/// The nearest of the candidates offered so far and the distance of the second nearest. The result
/// does not depend on the order of the offers: of equally near candidates the one with the lowest
/// index is the best.
struct BestTwo {
  int index = -1;                               ///< -1: nothing has been offered
  int distance_bits = kNoDistance_bits;         ///< of the nearest
  int second_distance_bits = kNoDistance_bits;  ///< of the second nearest

  /// @param candidate  0 or greater; each at most once
  void offer(int candidate, int candidate_distance_bits) {
    const bool nearer = candidate_distance_bits < distance_bits ||
                        (candidate_distance_bits == distance_bits && candidate < index);
    if (nearer) {
      second_distance_bits = distance_bits;
      distance_bits = candidate_distance_bits;
      index = candidate;
    } else if (candidate_distance_bits < second_distance_bits) {
      second_distance_bits = candidate_distance_bits;
    }
  }
};

/// @return whether the best candidate is a match: near enough and, unless it is the only one or the
/// ratio is 1, clearly nearer than the second. The cross check is the caller's, who knows the other
/// side.
inline bool accept(const BestTwo& best, const MatcherConfig& config) {
  if (best.index < 0 || best.distance_bits > config.max_hamming_bits) return false;
  if (config.ratio >= 1.0 || best.second_distance_bits == kNoDistance_bits) return true;
  return best.distance_bits < config.ratio * best.second_distance_bits;
}

}  // namespace ardrone_vslam
