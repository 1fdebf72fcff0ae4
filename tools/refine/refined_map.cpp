// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_map.hpp"

namespace ardrone_vslam {

SavedMap refinedMap(SavedMap map,
                    const std::unordered_map<std::int64_t, Eigen::Isometry3d>& T_map_base_at,
                    const std::vector<TrackPoint3d>& points) {
  // Joint points follow the single ones, and are the better places for what is seen again.
  std::unordered_map<std::uint32_t, const TrackPoint3d*> point_of;
  for (const TrackPoint3d& point : points) point_of[point.landmark_id] = &point;
  point_of.erase(0);

  std::vector<Eigen::Isometry3d> moved(map.anchors.size(), Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < map.anchors.size(); ++i) {
    MapAnchor& anchor = map.anchors[i];
    const auto found = T_map_base_at.find(anchor.stamp_ns);
    if (found == T_map_base_at.end()) continue;
    moved[i] = found->second * anchor.T_map_rig.inverse();
    anchor.T_map_rig = found->second;
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
