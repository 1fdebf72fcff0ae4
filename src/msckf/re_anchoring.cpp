// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/re_anchoring.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
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
         angleOf_rad(move.rotation) > tolerance_rad || std::abs(move.stretch - 1) > tolerance_rad;
}

}  // namespace

void AnchorCorrection::apply(Landmark& landmark) const {
  landmark.position_map =
      to_map + stretch * (rotation * Eigen::Vector3d(landmark.position_map - from_map));
  landmark.view_direction_map =
      (rotation * landmark.view_direction_map.cast<double>()).normalized().cast<float>();
  landmark.covariance_m2 =
      stretch * stretch * rotation * landmark.covariance_m2.full() * rotation.transpose();
  landmark.anchor_id = new_anchor_id;
}

std::vector<Clone>::iterator ReAnchoring::placeOf(std::uint32_t id) {
  return std::lower_bound(placed_.begin(), placed_.end(), id,
                          [](const Clone& one, std::uint32_t other) { return one.id < other; });
}

void ReAnchoring::begin(const Clone& frame) {
  const auto place = placeOf(frame.id);
  if (place != placed_.end() && place->id == frame.id) {
    *place = frame;
  } else {
    placed_.insert(place, frame);
  }
}

void ReAnchoring::join(const Clone& anchor, std::uint32_t to_anchor_id) {
  const auto placed = placeOf(anchor.id);
  if (placed == placed_.end() || placed->id != anchor.id) return;
  joined_.push_back(moveBetween(*placed, anchor));
  joined_.back().new_anchor_id = to_anchor_id;
  placed_.erase(placed);
}

std::vector<AnchorCorrection> ReAnchoring::take(const WindowState& state, double distance_m,
                                                double tolerance_rad) {
  std::vector<AnchorCorrection> moves;
  moves.swap(joined_);
  is_there_.assign(placed_.size(), 0);
  for (const auto* poses : {&state.anchors(), &state.frames()}) {
    for (const Clone& now : *poses) {
      const auto placed = placeOf(now.id);
      if (placed == placed_.end() || placed->id != now.id) continue;
      is_there_[static_cast<std::size_t>(placed - placed_.begin())] = 1;
      const AnchorCorrection move = moveBetween(*placed, now);
      if (!isSeen(move, distance_m, tolerance_rad)) continue;
      moves.push_back(move);
      *placed = now;
    }
  }
  const Clone* const first = placed_.data();
  const auto isGone = [&](const Clone& one) {
    return is_there_[static_cast<std::size_t>(&one - first)] == 0;
  };
  placed_.erase(std::remove_if(placed_.begin(), placed_.end(), isGone), placed_.end());
  return moves;
}

}  // namespace ardrone_vslam
