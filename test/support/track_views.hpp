// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/rotation.hpp"
#include "simulation/random_source.hpp"
#include "support/odometry_states.hpp"
#include "support/odometry_window.hpp"
#include "window/rays.hpp"

namespace ardrone_vslam::test {

/// Of the camera that the views below are of.
inline const Eigen::Vector3d kCamera_rig(0.2, 0.05, -0.1);

inline Clone poseAt(const Eigen::Vector3d& position_map, const Eigen::Vector3d& turn) {
  Clone pose;
  pose.position_map = position_map;
  pose.R_map_rig = rotationOf(turn);
  return pose;
}

inline Eigen::Vector3d bearingTo(const Eigen::Vector3d& point_map, const Clone& pose) {
  const Eigen::Vector3d offset = point_map - pose.position_map - pose.R_map_rig * kCamera_rig;
  return (pose.R_map_rig.transpose() * offset).normalized();
}

/// Frames that move sideways by 0.1 m, as the odometry says.
inline WindowState sidewaysWindow(int frames) {
  OdometryWindow state;
  state.add(odometryOfFrame(0, {0, 0, 0}));
  for (int i = 1; i < frames; ++i) state.add(odometryOfFrame(i, {0, 0.1 * i, 0.01 * (i % 2)}));
  return state;
}

constexpr double kSigma_rad = 0.002;

inline TrackView viewOf(std::size_t frame, const Eigen::Vector3d& ray,
                        double sigma_rad = kSigma_rad) {
  return {frame, ray.normalized(), rayRoot(ray.normalized(), sigma_rad)};
}

inline std::vector<TrackView> viewsOf(const Eigen::Vector3d& point_map, const WindowState& state,
                                      double noise_rad, RandomSource& random,
                                      double sigma_rad = kSigma_rad) {
  std::vector<TrackView> views;
  for (std::size_t i = 0; i < state.frames().size(); ++i) {
    const Eigen::Vector3d exact = bearingTo(point_map, state.frames()[i]);
    views.push_back(viewOf(i, exact + noise_rad * random.normal3(), sigma_rad));
  }
  return views;
}

}  // namespace ardrone_vslam::test
