// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/re_anchoring.hpp"

#include <algorithm>
#include <cmath>

#include "map/landmark_map.hpp"

namespace ardrone_vslam {
namespace {

AnchorCorrection moveBetween(const Clone& placed, const Clone& now) {
  AnchorCorrection move;
  move.anchor_id = placed.id;
  move.new_anchor_id = placed.id;
  move.from_map = placed.position_map;
  move.to_map = now.position_map;
  move.rotation = now.R_map_rig * placed.R_map_rig.transpose();
  move.stretch = now.stretch / placed.stretch;
  return move;
}

bool isSeen(const AnchorCorrection& move, double distance_m, double tolerance_rad) {
  return (move.to_map - move.from_map).norm() > tolerance_rad * distance_m ||
         Eigen::AngleAxisd(move.rotation).angle() > tolerance_rad ||
         std::abs(move.stretch - 1) > tolerance_rad;
}

}  // namespace

void AnchorCorrection::apply(Landmark& landmark) const {
  landmark.position_map =
      to_map + stretch * (rotation * Eigen::Vector3d(landmark.position_map - from_map));
  landmark.view_direction_map = rotation * landmark.view_direction_map;
  landmark.covariance_m2 =
      stretch * stretch * rotation * landmark.covariance_m2 * rotation.transpose();
  landmark.anchor_id = new_anchor_id;
}

void ReAnchoring::join(const Clone& anchor, std::uint32_t to_anchor_id) {
  const auto placed = placed_.find(anchor.id);
  if (placed == placed_.end()) return;
  joined_.push_back(moveBetween(placed->second, anchor));
  joined_.back().new_anchor_id = to_anchor_id;
  placed_.erase(placed);
}

std::vector<AnchorCorrection> ReAnchoring::take(const WindowState& state, double distance_m,
                                                double tolerance_rad) {
  std::vector<AnchorCorrection> moves;
  moves.swap(joined_);
  std::unordered_map<std::uint32_t, Clone> still_there;
  for (const auto* poses : {&state.anchors(), &state.frames()}) {
    for (const Clone& now : *poses) {
      const auto placed = placed_.find(now.id);
      if (placed == placed_.end()) continue;
      const AnchorCorrection move = moveBetween(placed->second, now);
      const bool is_seen = isSeen(move, distance_m, tolerance_rad);
      if (is_seen) moves.push_back(move);
      still_there[now.id] = is_seen ? now : placed->second;
    }
  }
  placed_.swap(still_there);
  return moves;
}

}  // namespace ardrone_vslam
