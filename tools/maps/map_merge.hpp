// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "ardrone_vslam/saved_map.hpp"
#include "maps/map_alignment.hpp"

namespace ardrone_vslam {

/// As many take minutes and some 500 MB; more, hours.
constexpr std::size_t kMostMergedAnchors = 400;

struct MergedMap {
  SavedMap map;            ///< in a's frame
  std::size_t shared = 0;  ///< landmarks that both maps had
  double apart_m = 0;    ///< of half of the pairs that agreed, at most, once the maps are corrected
  double sigma_m = 0;    ///< of where b lies in a, in the middle of these, per axis
  double sigma_rad = 0;  ///< of b's heading
};

/// What keeps two maps from being merged, whatever they show; empty when nothing does.
std::string mergeFault(const SavedMap& a, const SavedMap& b);

/// Two maps of one place as one. All anchors of both and where b lies in a are corrected together
/// by the landmarks that both have (an iterated update with the maps' joint covariances), so that
/// what one map knows better mends the other. Of a pair the landmark that was seen more often
/// stays. O((anchors of both)^3).
/// @param alignment  not by chance, so that some agree
/// @throws MapFileError with the mergeFault
MergedMap merge(const SavedMap& a, const SavedMap& b, const MapAlignment& alignment);

}  // namespace ardrone_vslam
