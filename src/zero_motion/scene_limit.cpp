// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/scene_limit.hpp"

#include <algorithm>
#include <cmath>

#include "zero_motion/zero_motion_update.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFewestTracks = 15;
// Faster odometry is believed: then the scene is further away than it is taken to be.
constexpr double kFastest_m_s = 0.5;
constexpr double kAttitudeSigmas = 2;
// A motion along the view moves the median corner by so many times less than one across.
constexpr double kAlongView = 3;

/// The displacement since a frame of the window is not longer than this across the view.
void limitDisplacement(std::size_t frame, double across_m, const Eigen::Vector3d& view_map,
                       WindowState& state) {
  const Eigen::Vector3d displacement_m =
      state.newest().position_map - state.frames()[frame].position_map;
  const Eigen::Matrix3d along = view_map * view_map.transpose();
  const Eigen::Matrix3d weight =
      (Eigen::Matrix3d::Identity() - along + along / (kAlongView * kAlongView)) /
      (across_m * across_m);
  if (displacement_m.dot(weight * displacement_m) < 1) return;  // within the limit it says nothing
  const int from = state.frameCoordinate(frame);
  const int to = state.frameCoordinate(state.frames().size() - 1);
  Information information({from, from + 1, from + 2, to, to + 1, to + 2});
  information.matrix << weight, -weight, -weight, weight;
  information.vector << weight * displacement_m, -weight * displacement_m;
  state.update(information);
}

}  // namespace

void limitByScene(const ImageFeatures& features, const TrackOrder& order, TrackWindow& tracks,
                  const Eigen::Vector3d& view_rig, double depth_m, WindowState& state) {
  const double least_rad = kCornerJump_px / features.focal_length_px;
  const Clone& newest = state.newest();
  // The oldest frame that shows the same: since then most drift has added up.
  for (std::size_t frame = 0; frame + 1 < state.frames().size(); ++frame) {
    const Clone& then = state.frames()[frame];
    const double displacement_m = (newest.position_map - then.position_map).norm();
    const double passed_s = static_cast<double>(newest.stamp_ns - then.stamp_ns) * 1e-9;
    if (displacement_m < depth_m * least_rad || displacement_m > kFastest_m_s * passed_s) continue;
    const TrackWindow::Motion motion = tracks.motionSince(then, newest, features, order);
    if (motion.common < kFewestTracks || motion.lost > motion.common) continue;
    // Half of what is seen is no further away; an attitude that is off may hide as much.
    const double seen_rad = std::max(motion.median_px / features.focal_length_px, least_rad);
    const double hidden_rad = kAttitudeSigmas * rotationSigma_rad(state, frame);
    limitDisplacement(frame, depth_m * std::hypot(seen_rad, hidden_rad),
                      newest.R_map_rig * view_rig, state);
    return;
  }
}

}  // namespace ardrone_vslam
