// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/fixed_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "linear/scalars.hpp"
#include "window/map_entry.hpp"

namespace ardrone_vslam {

FixedMap::FixedMap(SavedMap map) : map_(std::move(map)) {
  assert(!map_.anchors.empty());
}

SavedMap FixedMap::exact(MapEntry& entry) const {
  entry.anchor = 0;
  SavedMap exact = map_;
  exact.anchors.assign(1, {});
  exact.anchor_covariance.setZero(SavedMap::kAnchor, SavedMap::kAnchor);
  for (Landmark& landmark : exact.landmarks) landmark.anchor_id = 1;
  return exact;
}

void FixedMap::addErrors(Estimate& estimate) const {
  const Eigen::Vector3d position_map = estimate.T_map_base.translation();
  const auto distance_m = [&](const MapAnchor& anchor) {
    return (anchor.T_map_rig.translation() - position_map).norm();
  };
  const auto nearest =
      std::min_element(map_.anchors.begin(), map_.anchors.end(),
                       [&](const auto& a, const auto& b) { return distance_m(a) < distance_m(b); });
  const auto at = SavedMap::kAnchor * (nearest - map_.anchors.begin());
  const auto of_anchor = map_.anchor_covariance.block<SavedMap::kAnchor, SavedMap::kAnchor>(at, at);
  const PoseByAnchor J = poseByAnchor(position_map - nearest->T_map_rig.translation());
  estimate.covariance += J * of_anchor * J.transpose();
  constexpr int kScale = SavedMap::kAnchor - 1;
  estimate.scale_sigma = std::sqrt(squared(estimate.scale_sigma) + of_anchor(kScale, kScale));
}

}  // namespace ardrone_vslam
