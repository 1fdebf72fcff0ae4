// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "ardrone_vslam/saved_map.hpp"

namespace ardrone_vslam {

/// A corner that is seen from elsewhere is not quite the same point: standard deviation.
constexpr double kOtherView_m = 0.02;

/// The first of an anchor's SavedMap::kAnchor coordinates in the covariance.
inline Eigen::Index coordinateOf(std::size_t anchor) {
  return SavedMap::kAnchor * static_cast<Eigen::Index>(anchor);
}

/// The landmarks for which `isKept` holds, and the anchors that they belong to.
SavedMap partOf(const SavedMap& map, const std::function<bool(const Landmark&)>& isKept);

/// What must be true of a landmark to stay.
struct PruneRules {
  int least_seen = 0;                                             ///< times
  double most_sigma_m = std::numeric_limits<double>::infinity();  ///< of sigma_m
  std::size_t most = std::numeric_limits<std::size_t>::max();     ///< the most seen of all
};

SavedMap prune(const SavedMap& map, const PruneRules& rules);

/// How a landmark follows from its anchor's errors, [m] a coordinate of SavedMap::kAnchor: where
/// the share of distance is positive, it is nearer to the anchor than thought.
Eigen::Matrix<double, 3, SavedMap::kAnchor> byAnchor(const MapAnchor& anchor,
                                                     const Eigen::Vector3d& position_map);

/// A landmark's whole covariance [m^2]: its own, and by its anchor.
Eigen::Matrix3d covarianceOf(const SavedMap& map, const Landmark& landmark);

}  // namespace ardrone_vslam
