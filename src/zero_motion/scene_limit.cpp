// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/scene_limit.hpp"

#include <Eigen/LU>
#include <cmath>

#include "linear/scalars.hpp"
#include "zero_motion/seen_motion.hpp"
#include "zero_motion/zero_motion_update.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kOldCornerSigma_px = 1;  // between images that are seconds apart
constexpr double kAttitudeNoise_rad = 1e-4;
// Way over depth: further, parallax tells the way.
constexpr double kParallaxTells = 0.02;
// Within less the odometry knows the way better than an image does.
constexpr double kShortest_s = 1;
// The scene is between these quantiles of its depth.
constexpr double kNear = 0.1;
constexpr double kFar = 0.9;
// What is seen of the way, over its length, differs from track to track as their depths do.
constexpr double kUneven = 0.4;

/// The camera's displacement since a frame of the window is the way seen, times the depth.
void limitDisplacement(std::size_t frame, const SeenMotion& seen, const SceneDepth& depth,
                       const Eigen::Vector3d& camera_rig, WindowState& state) {
  const Clone& then = state.frames()[frame];
  const Clone& newest = state.newest();
  const double near_m = depth.quantile_m(kNear);
  const double far_m = depth.quantile_m(kFar);
  const Eigen::Vector3d displacement_map = then.R_map_rig * seen.displacement;
  const Eigen::Vector3d off_m = newest.position_map - then.position_map +
                                (newest.R_map_rig - then.R_map_rig) * camera_rig -
                                0.5 * (near_m + far_m) * displacement_map;
  Eigen::Matrix3d variance_m2 =
      squared(far_m) * then.R_map_rig * seen.covariance * then.R_map_rig.transpose() +
      squared(0.5 * (far_m - near_m)) * displacement_map * displacement_map.transpose();
  variance_m2.diagonal().array() += squared(kUneven * far_m) * displacement_map.squaredNorm();
  const Eigen::Matrix3d weight = variance_m2.inverse();
  if (!mayBeDrift(off_m.norm(), seconds(newest.stamp_ns - then.stamp_ns))) return;
  if (off_m.dot(weight * off_m) < 1) return;  // it need not be drift
  const int from = state.frameCoordinate(frame);
  const int to = state.frameCoordinate(state.frames().size() - 1);
  Information information({from, from + 1, from + 2, to, to + 1, to + 2});
  information.matrix << weight, -weight, -weight, weight;
  information.vector << weight * off_m, -weight * off_m;
  state.update(information);
}

}  // namespace

void limitByScene(const ImageFeatures& features, const TrackOrder& order,
                  const Eigen::Vector3d& camera_rig, const SceneDepth& depth, TrackWindow& tracks,
                  WindowState& state) {
  // The oldest frame that shows the same: since then most drift has added up.
  for (std::size_t frame = 0; frame + 1 < state.frames().size(); ++frame) {
    const Clone& then = state.frames()[frame];
    if (seconds(state.newest().stamp_ns - then.stamp_ns) < kShortest_s) return;
    const TrackWindow::Common common = tracks.commonWith(then.id, features, order);
    const std::size_t pairs = common.pairs.size();
    if (pairs < kFewestPairs || static_cast<std::size_t>(common.lost) > pairs) continue;
    const auto seen =
        seenMotion(common.pairs, then.R_map_rig.transpose() * state.newest().R_map_rig,
                   rotationSigma_rad(state, frame) + kAttitudeNoise_rad,
                   kOldCornerSigma_px / features.focal_length_px);
    if (seen && seen->displacement.norm() < kParallaxTells)
      limitDisplacement(frame, *seen, depth, camera_rig, state);
    return;
  }
}

}  // namespace ardrone_vslam
