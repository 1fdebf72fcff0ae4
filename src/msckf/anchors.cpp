// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/anchors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

// Landmarks share the error of the frame they belong to. A new one begins when the view differs so
// much that they would not: after this share of the landmarks' distance, or this rotation.
constexpr double kSpacing = 0.3;
constexpr double kRotation_deg = 20;
// Anchors on both sides of a break may be further from each other than they seem to be.
constexpr double kUnseenWay_m = 10;

}  // namespace

void Anchors::choose(const WindowState& state, double point_distance_m) {
  const Clone& newest = state.newest();
  if (const auto frame = indexOf(state.frames(), current_id_)) {
    const Clone& anchor = state.frames()[*frame];
    const double displacement_m = (newest.position_map - anchor.position_map).norm();
    const double rotation_rad = angleOf_rad(newest.R_map_rig.transpose() * anchor.R_map_rig);
    if (displacement_m < kSpacing * point_distance_m && rotation_rad < kRotation_deg * M_PI / 180)
      return;
  }
  // The first one after a break that no landmark belongs to hands that on.
  const bool hands_on = after_a_break_.count(current_id_) > 0 && in_use_.count(current_id_) == 0;
  if (current_id_ == 0 || hands_on) after_a_break_.insert(newest.id);
  current_id_ = newest.id;
  re_anchoring_.begin(newest);
}

void Anchors::retire(std::size_t frame, WindowState& state) {
  if (in_use_.erase(state.frames()[frame].id) == 0) {
    if (after_a_break_.erase(state.frames()[frame].id) > 0 &&
        state.frames()[frame].id == current_id_)
      current_id_ = 0;
    state.removeFrame(frame);
    return;
  }
  state.makeAnchor(frame);
  if (static_cast<int>(state.anchors().size()) > config_.max_anchors) joinNearest(state);
}

void Anchors::joinNearest(WindowState& state) {
  const auto& anchors = state.anchors();
  std::size_t nearest = 1;
  double shortest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < anchors.size(); ++i) {
    double distance_m = (anchors[i].position_map - anchors[i - 1].position_map).norm();
    if (after_a_break_.count(anchors[i].id) > 0) distance_m += kUnseenWay_m;
    if (distance_m >= shortest_m || anchors[i].is_loaded != anchors[i - 1].is_loaded) continue;
    shortest_m = distance_m;
    nearest = i;
  }
  re_anchoring_.join(anchors[nearest], anchors[nearest - 1].id);
  after_a_break_.erase(anchors[nearest].id);
  state.removeAnchor(nearest);
}

std::vector<AnchorCorrection> Anchors::takeCorrections(const WindowState& state,
                                                       double point_distance_m,
                                                       double focal_length_px) {
  constexpr double kUnseenSigmas = 0.3;  // of a match's corner: less, none of them can feel
  return re_anchoring_.take(state, point_distance_m,
                            kUnseenSigmas * config_.track_sigma_px / focal_length_px);
}

std::vector<AnchorDrift> driftsOf(const WindowState& state) {
  const int n = state.frameCoordinate(state.frames().size() - 1);
  std::vector<AnchorDrift> drifts;
  drifts.reserve(state.anchors().size() + state.frames().size());
  const auto add = [&](const Clone& pose, int a) {
    const Matrix6d relative = state.relativeCovariance(n, a);
    drifts.push_back({pose.id, std::max(relative.topLeftCorner<3, 3>().trace() / 3, 0.0),
                      std::max(relative.bottomRightCorner<3, 3>().trace() / 3, 0.0)});
  };
  for (std::size_t i = 0; i < state.anchors().size(); ++i)
    add(state.anchors()[i], state.anchorCoordinate(i));
  for (std::size_t i = 0; i < state.frames().size(); ++i)
    add(state.frames()[i], state.frameCoordinate(i));
  // The reference of the zero-motion update may be older than anchors.
  std::sort(drifts.begin(), drifts.end(),
            [](const AnchorDrift& a, const AnchorDrift& b) { return a.anchor_id < b.anchor_id; });
  return drifts;
}

}  // namespace ardrone_vslam
