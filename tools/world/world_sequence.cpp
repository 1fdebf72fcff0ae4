// SPDX-License-Identifier: BSD-3-Clause
#include "world/world_sequence.hpp"

#include <cmath>
#include <stdexcept>

#include "folders/range_readings.hpp"
#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kFirstStamp_ns = 1000000000;
constexpr double kMostImages = 1e7;

std::size_t imageCount(const WorldOptions& options) {
  const double count = std::round(options.duration_s * options.rate_hz);
  if (!(options.rate_hz > 0) || !(count >= 1) || !(count <= kMostImages)) {
    throw std::invalid_argument(
        "seconds times rate must give at least one image and at most ten million");
  }
  return static_cast<std::size_t>(count);
}

bool isCorridor(const std::string& world) {
  return world == "corridor";
}

/// Of base. It errs about the drone's axes, whose z is up; base itself may lie otherwise.
OdometryRun simulateUpright(const Trajectory& truth, const Eigen::Matrix3d& R_body_base,
                            const OdometryProfile& profile, std::uint64_t seed) {
  Trajectory upright;
  for (const StampedPose& pose : truth.poses())
    upright.append({pose.stamp_ns, pose.T_frame_body * Eigen::Isometry3d(R_body_base.transpose())});
  OdometryRun odometry = simulateOdometry(upright, profile, seed);
  for (OdometryState& state : odometry.states)
    state.T_odom_base = state.T_odom_base * Eigen::Isometry3d(R_body_base);
  return odometry;
}

}  // namespace

World makeWorldFor(const WorldOptions& options) {
  const FlightInfo& info = flightInfo(options.flight);
  const std::string name = options.world.value_or(info.world);
  if (isCorridor(name) != isCorridor(info.world)) {
    throw std::invalid_argument("the flight " + info.name + " does not fit into the world '" +
                                name + "'; its own is " + info.world);
  }
  return makeWorld(name, options.light.value_or(info.light), options.world_seed);
}

WorldSequence::WorldSequence(const WorldOptions& options)
    : options_(options),
      flight_(makeFlight(options.flight, options.start)),
      world_(makeWorldFor(options)),
      camera_(options.camera, options.effects) {
  flyTruth();
  if (options.odometry)
    odometry_ = simulateUpright(truth_, T_body_base().linear(), *options.odometry, options.seed);
  if (options.range_noise_m) {
    const auto range_m = [this](const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns) {
      return world_.rangeBelow_m(T_map_base, static_cast<double>(stamp_ns - kFirstStamp_ns) * 1e-9);
    };
    ranges_ = simulateRanges(truth_, range_m, *options.range_noise_m, options.seed);
  }
}

Eigen::Isometry3d WorldSequence::T_world_base(double t_s) const {
  return flight_->pose(t_s) * T_body_base();
}

void WorldSequence::flyTruth() {
  const std::size_t count = imageCount(options_);
  for (std::size_t i = 0; i < count; ++i) {
    truth_.append({kFirstStamp_ns + std::llround(seconds(i) * 1e9), T_world_base(seconds(i))});
  }
}

cv::Mat WorldSequence::image(std::size_t index) {
  const double t_s = seconds(index);
  const auto motion = [&](double since_stamp_s) {
    return T_world_base(t_s + since_stamp_s) * options_.T_base_cam;
  };
  return camera_.shoot(world_.at(t_s), motion,
                       RandomSource::mix(options_.seed) + static_cast<std::uint64_t>(index));
}

}  // namespace ardrone_vslam
