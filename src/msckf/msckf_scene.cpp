// SPDX-License-Identifier: BSD-3-Clause
// What the MSCKF does when the odometry has gone further than the image shows.
#include <algorithm>
#include <cmath>

#include "msckf/msckf.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFewestTracks = 15;
// Faster odometry is believed: then the scene is further away than it is taken to be.
constexpr double kFastest_m_s = 0.5;
constexpr double kAttitudeSigmas = 2;
// A way along the view moves the median corner by so many times less than one across.
constexpr double kAlongView = 3;

}  // namespace

void Msckf::holdToScene(const ImageFeatures& features) {
  if (isLocated() || motion_ == CameraMotion::kResting) return;
  // Not the landmarks' distance: what drift made is as much too far away.
  const double depth_m = config_.rest.rest_depth_m;
  const double least_rad = config_.rest.rest_sigma_px / features.focal_length_px;
  const std::size_t newest_frame = state_.frames().size() - 1;
  // The oldest frame that shows the same: since then most drift has added up.
  for (std::size_t frame = 0; frame < newest_frame; ++frame) {
    const Clone& then = state_.frames()[frame];
    const double displacement_m = (newest().position_map - then.position_map).norm();
    const double passed_s = static_cast<double>(newest().stamp_ns - then.stamp_ns) * 1e-9;
    if (displacement_m < depth_m * least_rad || displacement_m > kFastest_m_s * passed_s) continue;
    const TrackWindow::Motion motion = tracks_.motionSince(then, newest(), features, order_);
    if (motion.common < kFewestTracks || motion.lost > motion.common) continue;
    // Half of what is seen is no further away; an attitude that is off may hide as much.
    const double seen_rad = std::max(motion.median_px / features.focal_length_px, least_rad);
    limitDisplacement(frame,
                      depth_m * std::hypot(seen_rad, kAttitudeSigmas * rotationSigma_rad(frame)));
    return;
  }
}

void Msckf::limitDisplacement(std::size_t frame, double across_m) {
  const Eigen::Vector3d displacement_m =
      newest().position_map - state_.frames()[frame].position_map;
  const Eigen::Vector3d view = newest().R_map_rig * R_base_cam_.col(2);
  const Eigen::Matrix3d along = view * view.transpose();
  const Eigen::Matrix3d weight =
      (Eigen::Matrix3d::Identity() - along + along / (kAlongView * kAlongView)) /
      (across_m * across_m);
  if (displacement_m.dot(weight * displacement_m) < 1) return;  // within the limit it says nothing
  const int from = state_.frameCoordinate(frame);
  const int to = state_.frameCoordinate(state_.frames().size() - 1);
  Information information({from, from + 1, from + 2, to, to + 1, to + 2});
  information.matrix << weight, -weight, -weight, weight;
  information.vector << weight * displacement_m, -weight * displacement_m;
  state_.update(information);
}

}  // namespace ardrone_vslam
