// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_map.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "refine/refined_path.hpp"

namespace ardrone_vslam {
namespace {

/// The landmarks without a point keep the stretch that they had in flight.
void useCovariance(const Eigen::MatrixXd& refined, SavedMap& map) {
  if (refined.rows() != map.anchor_covariance.rows()) return;
  const Eigen::MatrixXd flown = std::exchange(map.anchor_covariance, refined);
  for (Eigen::Index i = SavedMap::kAnchor - 1; i < refined.rows(); i += SavedMap::kAnchor)
    map.anchor_covariance(i, i) = std::max(refined(i, i), flown(i, i));
}

}  // namespace

SavedMap refinedMap(SavedMap map, const FlightRecord& record, const Refinement& refinement) {
  map.flight = {};
  if (record.keyframes.empty()) return map;
  // Joint points follow the single ones, and are the better places for what is seen again.
  std::unordered_map<std::uint32_t, const TrackPoint3d*> point_of;
  for (const TrackPoint3d& point : refinement.points) point_of[point.landmark_id] = &point;
  point_of.erase(0);

  const PosesByStamp T_map_rig_at = refinedPoses(record, refinement);
  std::vector<Eigen::Isometry3d> moved;  // T_new_old of the anchors
  moved.reserve(map.anchors.size());
  bool are_all_known = true;
  for (MapAnchor& anchor : map.anchors) {
    const auto found = T_map_rig_at.find(anchor.stamp_ns);
    if (found != T_map_rig_at.end()) {
      moved.emplace_back(found->second * anchor.T_map_rig.inverse());
    } else {
      are_all_known = false;
      moved.push_back(moved.empty() ? Eigen::Isometry3d::Identity() : moved.back());
    }
    anchor.T_map_rig = moved.back() * anchor.T_map_rig;
  }
  if (are_all_known) useCovariance(refinement.anchor_covariance, map);
  for (Landmark& landmark : map.landmarks) {
    const Eigen::Isometry3d& T_new_old = moved[landmark.anchor_id - 1];
    const Eigen::Matrix3d& R = T_new_old.linear();
    landmark.view_direction_map = R.cast<float>() * landmark.view_direction_map;
    landmark.covariance_m2 = R * landmark.covariance_m2.full() * R.transpose();
    const auto found = point_of.find(landmark.id);
    landmark.position_map =
        found == point_of.end() ? T_new_old * landmark.position_map : found->second->position_map;
  }
  return map;
}

}  // namespace ardrone_vslam
