// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/fixed_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "window/map_entry.hpp"

namespace ardrone_vslam {

FixedMap::FixedMap(SavedMap& map, MapEntry& entry) {
  assert(!map.anchors.empty());
  std::vector<std::uint32_t> anchors;
  anchors.reserve(map.landmarks.size());
  for (Landmark& landmark : map.landmarks) anchors.push_back(std::exchange(landmark.anchor_id, 1));
  anchors_ = std::make_shared<const std::vector<std::uint32_t>>(std::move(anchors));
  entry.anchor = 0;
  map_.frame_id = map.frame_id;
  map_.cameras = map.cameras;
  map_.anchors.assign(1, {});
  map_.anchors.swap(map.anchors);
  map_.anchor_covariance.setZero(SavedMap::kAnchor, SavedMap::kAnchor);
  map_.anchor_covariance.swap(map.anchor_covariance);
}

MapSnapshot FixedMap::snapshotWith(const Landmarks& landmarks, std::int64_t stamp_ns) const {
  assert(landmarks.size() == anchors_->size());
  MapSnapshot snapshot(map_);
  snapshot.all_but_landmarks.stamp_ns = stamp_ns;
  snapshot.landmarks = landmarks;
  snapshot.anchor_of_landmark = anchors_;
  return snapshot;
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
  estimate.scale_sigma = std::max(estimate.scale_sigma, std::sqrt(of_anchor(kScale, kScale)));
}

}  // namespace ardrone_vslam
