// SPDX-License-Identifier: BSD-3-Clause
#include "maps/map_parts.hpp"

#include <algorithm>

#include "ardrone_vslam/landmark_worth.hpp"
#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {

SavedMap partOf(const SavedMap& map, const std::function<bool(const Landmark&)>& isKept) {
  SavedMap part = map;
  const auto end =
      std::remove_if(part.landmarks.begin(), part.landmarks.end(), std::not_fn(isKept));
  part.landmarks.erase(end, part.landmarks.end());
  part.flight = {};
  keepUsedAnchors(part);
  return part;
}

SavedMap prune(const SavedMap& map, const PruneRules& rules) {
  SavedMap part = partOf(map, [&rules](const Landmark& landmark) {
    return landmark.times_seen >= rules.least_seen && landmark.sigma_m <= rules.most_sigma_m;
  });
  if (part.landmarks.size() <= rules.most) return part;
  std::vector<std::uint32_t> spare =
      leastWorth(Landmarks(part.landmarks), part.landmarks.size() - rules.most);
  std::sort(spare.begin(), spare.end());
  return partOf(part, [&spare](const Landmark& landmark) {
    return !std::binary_search(spare.begin(), spare.end(), landmark.id);
  });
}

Eigen::Matrix<double, 3, SavedMap::kAnchor> byAnchor(const MapAnchor& anchor,
                                                     const Eigen::Vector3d& position_map) {
  const Eigen::Vector3d from_anchor = position_map - anchor.T_map_rig.translation();
  Eigen::Matrix<double, 3, SavedMap::kAnchor> J;
  J << Eigen::Matrix3d::Identity(), -skew(from_anchor), -from_anchor;
  return J;
}

Eigen::Matrix3d covarianceOf(const SavedMap& map, const Landmark& landmark) {
  const std::size_t anchor = landmark.anchor_id - 1;
  const auto J = byAnchor(map.anchors[anchor], landmark.position_map);
  const auto P = map.anchor_covariance.block<SavedMap::kAnchor, SavedMap::kAnchor>(
      coordinateOf(anchor), coordinateOf(anchor));
  return landmark.covariance_m2.full() + J * P * J.transpose();
}

}  // namespace ardrone_vslam
