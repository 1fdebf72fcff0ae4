// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// A landmark of each of two maps, by index, that look alike.
struct LandmarkPair {
  std::size_t of_a = 0;
  std::size_t of_b = 0;
};

/// Pairs each of which is the other's nearest by descriptor, and clearly so. O(landmarks of a times
/// landmarks of b).
/// @param progress  is told how many landmarks of a are done
std::vector<LandmarkPair> pairsOf(const SavedMap& a, const SavedMap& b,
                                  const std::function<void(std::size_t)>& progress = {});

/// Whether one of the maps was made from the other: no two flights see a corner as the very same
/// descriptor, and less so several. Their errors are the same ones, and merging would count them as
/// two.
bool areOfOneFlight(const SavedMap& a, const SavedMap& b, const std::vector<LandmarkPair>& pairs);

/// Where b lies in a: both know where up is, so position and heading are all.
struct MapAlignment {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  std::vector<LandmarkPair> agreed;  ///< pairs that lie in one place by it
  bool is_chance = true;             ///< that many agree among random pairs, too
};

/// By consensus of two pairs and least squares, each pair weighted by its landmarks' covariances.
MapAlignment align(const SavedMap& a, const SavedMap& b, const std::vector<LandmarkPair>& pairs);

}  // namespace ardrone_vslam
