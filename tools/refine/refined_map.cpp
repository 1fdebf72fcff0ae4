// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_map.hpp"

#include <unordered_map>

#include "refine/refined_path.hpp"

namespace ardrone_vslam {

SavedMap refinedMap(SavedMap map, const FlightRecord& record, const Refinement& refinement) {
  map.flight = {};
  if (refinement.anchor_covariance.size() > 0) map.anchor_covariance = refinement.anchor_covariance;
  if (record.keyframes.empty()) return map;
  // Joint points follow the single ones, and are the better places for what is seen again.
  std::unordered_map<std::uint32_t, const TrackPoint3d*> point_of;
  for (const TrackPoint3d& point : refinement.points) point_of[point.landmark_id] = &point;
  point_of.erase(0);

  const PosesByStamp T_map_base_at = refinedPoses(record, refinement);
  const Eigen::Isometry3d T_last_new_old =
      refinement.T_map_base.back() * record.keyframes.back().T_map_base.inverse();
  std::vector<Eigen::Isometry3d> moved;  // T_new_old of the anchors
  moved.reserve(map.anchors.size());
  for (MapAnchor& anchor : map.anchors) {
    const auto found = T_map_base_at.find(anchor.stamp_ns);
    const bool is_known = found != T_map_base_at.end();
    moved.push_back(is_known ? found->second * anchor.T_map_rig.inverse() : T_last_new_old);
    anchor.T_map_rig = moved.back() * anchor.T_map_rig;
  }
  for (Landmark& landmark : map.landmarks) {
    const Eigen::Isometry3d& T_new_old = moved[landmark.anchor_id - 1];
    landmark.view_direction_map = T_new_old.linear() * landmark.view_direction_map;
    const auto found = point_of.find(landmark.id);
    landmark.position_map =
        found == point_of.end() ? T_new_old * landmark.position_map : found->second->position_map;
  }
  return map;
}

}  // namespace ardrone_vslam
