// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "landmarks/simulated_street.hpp"
#include "run/front_end.hpp"

namespace ardrone_vslam {

/// A car's way along a street with landmarks beside it.
struct Scene {
  Trajectory path;
  std::vector<TrackedFrame> frames;
};

/// Straight on between landmarks, so that each image has about so many features.
/// @param frames  more than 60
inline Scene streetWith(int features, int frames) {
  constexpr double kStep_m = 0.8;  // a car at 10 Hz
  constexpr std::size_t kCounted = 60;
  Scene scene;
  std::vector<StampedPose> poses;
  for (int i = 0; i < frames; ++i) {
    StampedPose pose;
    pose.stamp_ns = 100'000'000LL * (i + 1);
    pose.T_frame_body.translation() << kStep_m * i, 0, 0;
    poses.push_back(pose);
  }
  scene.path = Trajectory(std::move(poses));
  ViewFaults faults;
  faults.pixel_noise_px = 0.8;
  faults.wrong_share = 0.03;
  StreetConfig street;
  double seen_of_10000 = 0;
  for (const int landmarks : {10000, 0}) {
    street.landmarks = landmarks > 0 ? landmarks : static_cast<int>(1e4 * features / seen_of_10000);
    FrameTrackerConfig tracks;
    tracks.search_radius_px = 120;
    PointWorld world(1, faults, streetCamera(), tracks);
    addStreet(world, scene.path, street, 1);
    scene.frames.clear();
    for (const StampedPose& pose : scene.path.poses()) {
      TrackedFrame& frame = scene.frames.emplace_back();
      frame.features = world.look(pose.T_frame_body * forwardCamera(), pose.stamp_ns);
    }
    seen_of_10000 = static_cast<double>(scene.frames[kCounted].features.size());
  }
  return scene;
}

/// The odometry's states at the frames: the truth.
inline std::vector<OdometryState> truthOf(const Trajectory& path) {
  std::vector<OdometryState> states;
  for (const StampedPose& pose : path.poses()) {
    OdometryState state;
    state.stamp_ns = pose.stamp_ns;
    state.T_odom_base = pose.T_frame_body;
    states.push_back(state);
  }
  return states;
}

/// As wide as a street, with the odometry of truthOf().
inline SlamConfig streetConfig(EstimatorKind estimator) {
  SlamConfig config;
  config.estimator = estimator;
  config.landmark_map.max_landmarks = 10000000;
  config.msckf.odometry.walk_m_per_sqrt_m = 0.005;
  config.msckf.odometry.walk_m_per_sqrt_s = 0.001;
  return config;
}

}  // namespace ardrone_vslam
