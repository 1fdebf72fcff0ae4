// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/slam.hpp"
#include "support/point_world.hpp"

namespace ardrone_vslam::test {

struct FlightPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();
};
using Flight = std::vector<FlightPose>;

inline std::int64_t stampOf(int frame, double rate_hz) {
  return 1'000'000'000 + static_cast<std::int64_t>(std::llround(frame / rate_hz * 1e9));
}

constexpr int kLapFrames = 200;  ///< of a lap at 10 Hz, 0.79 m/s

/// Circles of a radius at a height, looking along the way.
inline Flight lapsFlight(int frames_per_lap, int laps, double rate_hz, double radius_m = 2.5,
                         double height_m = 1.2) {
  Flight flight;
  for (int i = 0; i < frames_per_lap * laps; ++i) {
    const double turn = 2 * M_PI * i / frames_per_lap;
    FlightPose pose;
    pose.stamp_ns = stampOf(i, rate_hz);
    pose.T_map_base.linear() =
        Eigen::AngleAxisd(turn + M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.T_map_base.translation() << radius_m * std::cos(turn), radius_m * std::sin(turn), height_m;
    flight.push_back(pose);
  }
  return flight;
}

/// Straight along x in the middle of a corridor; no place is seen twice.
inline Flight straightFlight(int frames, double rate_hz, double speed_m_s) {
  Flight flight;
  for (int i = 0; i < frames; ++i) {
    FlightPose pose;
    pose.stamp_ns = stampOf(i, rate_hz);
    pose.T_map_base.translation() << speed_m_s * i / rate_hz, 0, 1.2;
    flight.push_back(pose);
  }
  return flight;
}

/// Odometry with exact attitude whose position drifts.
struct DriftConfig {
  double walk_m_per_sqrt_s = 0.03;
  double bias_m_s = 0.01;  ///< sigma per axis of a constant velocity error
  double scale_error = 0;  ///< ways are reported (1 + scale_error) times as long
};

inline std::vector<OdometryState> observe(const Flight& flight, const DriftConfig& drift,
                                          std::uint64_t seed) {
  RandomSource random(seed, 77);
  const Eigen::Vector3d bias_m_s = drift.bias_m_s * random.normal3();
  Eigen::Vector3d error_m = Eigen::Vector3d::Zero();
  std::vector<OdometryState> states;
  const FlightPose* last = nullptr;
  for (const FlightPose& pose : flight) {
    if (!states.empty()) {
      const double dt_s = static_cast<double>(pose.stamp_ns - states.back().stamp_ns) * 1e-9;
      error_m += bias_m_s * dt_s + drift.walk_m_per_sqrt_s * std::sqrt(dt_s) * random.normal3();
      error_m +=
          drift.scale_error * (pose.T_map_base.translation() - last->T_map_base.translation());
    }
    OdometryState state;
    state.stamp_ns = pose.stamp_ns;
    state.T_odom_base = pose.T_map_base;
    state.T_odom_base.translation() += error_m;
    states.push_back(state);
    last = &pose;
  }
  return states;
}

/// The default estimator, told of the walk that observe() draws.
inline SlamConfig configForDrift() {
  SlamConfig config;
  config.msckf.odometry.walk_m_per_sqrt_s = DriftConfig{}.walk_m_per_sqrt_s;
  return config;
}

inline std::vector<OdometryState> observeExactly(const Flight& flight) {
  return observe(flight, {0, 0}, 0);
}

/// Root mean square and largest distance of poses from the truth.
struct PositionError {
  double rmse_m = 0;
  double max_m = 0;
};

template <class PositionAt>
PositionError errorOf(const Flight& flight, PositionAt&& position_at) {
  PositionError error;
  for (std::size_t i = 0; i < flight.size(); ++i) {
    const double distance_m = (position_at(i) - flight[i].T_map_base.translation()).norm();
    error.rmse_m += distance_m * distance_m;
    error.max_m = std::max(error.max_m, distance_m);
  }
  error.rmse_m = std::sqrt(error.rmse_m / static_cast<double>(flight.size()));
  return error;
}

/// What a run of Slam over a flight gave.
struct FlightRun {
  std::vector<FrameResult> results;
  Landmarks landmarks;
  PositionError fused;
  PositionError odometry;
};

/// What the camera sees on the flight, frame by frame.
inline std::vector<ImageFeatures> film(PointWorld& world, const Flight& flight) {
  std::vector<ImageFeatures> frames;
  for (const FlightPose& pose : flight)
    frames.push_back(world.look(pose.T_map_base * forwardExtrinsics(), pose.stamp_ns));
  return frames;
}

inline SlamConfig thesisConfig() {
  SlamConfig config;
  config.estimator = EstimatorKind::kThesis;
  return config;
}

/// Frames and odometry states of equal stamps through Slam.
inline FlightRun run(const std::vector<ImageFeatures>& frames,
                     const std::vector<OdometryState>& odometry, const SlamConfig& config) {
  Slam slam(config, forwardExtrinsics());
  FlightRun run;
  for (std::size_t i = 0; i < frames.size(); ++i)
    run.results.push_back(slam.process(frames[i], odometry[i]));
  run.landmarks = slam.landmarks();
  return run;
}

/// The same, with errors.
inline FlightRun fly(PointWorld& world, const Flight& flight,
                     const std::vector<OdometryState>& odometry, const SlamConfig& config) {
  FlightRun flown = run(film(world, flight), odometry, config);
  flown.fused =
      errorOf(flight, [&](std::size_t i) { return flown.results[i].T_map_base.translation(); });
  flown.odometry =
      errorOf(flight, [&](std::size_t i) { return odometry[i].T_odom_base.translation(); });
  return flown;
}

/// Landmark matches a frame, in the mean over the frames `first` .. `last` - 1.
inline double meanMatches(const FlightRun& run, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += run.results[i].landmark_matches;
  return sum / static_cast<double>(last - first);
}

inline SlamConfig msckfConfig() {
  SlamConfig config;
  config.estimator = EstimatorKind::kMsckf;
  return config;
}

/// How many results from the frame `first` on are of that state.
inline int framesIn(const FlightRun& run, SlamState state, std::size_t first = 0) {
  return static_cast<int>(
      std::count_if(run.results.begin() + static_cast<std::ptrdiff_t>(first), run.results.end(),
                    [state](const FrameResult& result) { return result.state == state; }));
}

}  // namespace ardrone_vslam::test
