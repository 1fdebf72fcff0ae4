// SPDX-License-Identifier: BSD-3-Clause
// The frames whose errors landmarks share, and what becomes of frames that leave the window.
#include <algorithm>
#include <cmath>
#include <limits>

#include "msckf/msckf.hpp"

namespace ardrone_vslam {

void Msckf::chooseAnchor() {
  if (const auto frame = frameOf(anchor_id_)) {
    const Clone& anchor = state_.frames()[*frame];
    const double displacement_m = (newest().position_map - anchor.position_map).norm();
    const double rotation_rad =
        Eigen::AngleAxisd(newest().R_map_rig.transpose() * anchor.R_map_rig).angle();
    if (displacement_m < config_.anchor_spacing * point_distance_m_ &&
        rotation_rad < config_.anchor_turn_deg * M_PI / 180)
      return;
  }
  anchor_id_ = newest().id;
  moves_.begin(newest());
}

std::vector<AnchorCorrection> Msckf::takeMoves(double focal_length_px) {
  constexpr double kUnseen_px = 0.3;
  return moves_.take(state_, point_distance_m_, kUnseen_px / focal_length_px);
}

std::vector<AnchorDrift> Msckf::drifts() const {
  const int n = state_.frameCoordinate(state_.frames().size() - 1);
  std::vector<AnchorDrift> drifts;
  const auto add = [&](const Clone& pose, int a) {
    const Matrix6d relative = state_.relativeCovariance(n, a);
    drifts.push_back({pose.id, std::max(relative.topLeftCorner<3, 3>().trace() / 3, 0.0),
                      std::max(relative.bottomRightCorner<3, 3>().trace() / 3, 0.0)});
  };
  for (std::size_t i = 0; i < state_.anchors().size(); ++i)
    add(state_.anchors()[i], state_.anchorCoordinate(i));
  for (std::size_t i = 0; i < state_.frames().size(); ++i)
    add(state_.frames()[i], state_.frameCoordinate(i));
  // The frame that rest is told by may be older than anchors.
  std::sort(drifts.begin(), drifts.end(),
            [](const AnchorDrift& a, const AnchorDrift& b) { return a.anchor_id < b.anchor_id; });
  return drifts;
}

void Msckf::dropOldest() {
  const auto& frames = state_.frames();
  const std::size_t oldest = frames.front().id == reference_id_ && !reference_is_keyframe_ ? 1 : 0;
  const std::uint32_t id = frames[oldest].id;
  tracks_.dropFrame(id);
  if (anchors_in_use_.erase(id) == 0) {
    state_.removeFrame(oldest);
    return;
  }
  state_.makeAnchor(oldest);
  if (static_cast<int>(state_.anchors().size()) > config_.max_anchors) joinAnchors();
}

void Msckf::joinAnchors() {
  const auto& anchors = state_.anchors();
  std::size_t nearest = 1;
  double shortest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < anchors.size(); ++i) {
    const double displacement_m = (anchors[i].position_map - anchors[i - 1].position_map).norm();
    if (displacement_m >= shortest_m) continue;
    shortest_m = displacement_m;
    nearest = i;
  }
  moves_.join(anchors[nearest], anchors[nearest - 1].id);
  state_.removeAnchor(nearest);
}

}  // namespace ardrone_vslam
