// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sequences/drone_cameras.hpp"
#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"
#include "world/flight/world_flight.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {

/// What make_world renders.
struct WorldOptions {
  std::string flight = "laps";
  double duration_s = 60;
  double rate_hz = 30;  ///< of the images
  /// The odometry's profile; nothing: the sequence has no odometry.
  std::optional<OdometryProfile> odometry;
  std::optional<double> range_noise_m;  ///< nothing: the sequence has no ranges
  std::uint64_t seed = 0;               ///< noise of the odometry, the ranges and the images
  std::uint64_t world_seed = 0;         ///< the world
  std::optional<FlightStart> start;
  std::optional<std::string> world;  ///< nothing: the flight's own
  std::optional<std::string> light;  ///< nothing: the flight's own
  CameraIntrinsics camera = arDroneFrontCamera();
  Eigen::Isometry3d T_body_cam = arDroneFrontMount();
  /// Where base is: T_body_cam makes it the middle of the drone and forwardCamera() the camera's
  /// own position.
  Eigen::Isometry3d T_base_cam = arDroneFrontMount();
  CameraEffects effects;
};

/// The world that the options name, else the flight's own.
/// @throws std::invalid_argument when the flight does not fit into it
World makeWorldFor(const WorldOptions& options);

/// A synthetic flight: rendered images, exact truth at each image, simulated odometry. Stamps begin
/// at 1 s (ROS takes 0 for "none"). Images may be asked for in any order and often.
class WorldSequence : public Sequence {
 public:
  /// Paints the world: takes about a second.
  /// @throws std::invalid_argument for an unknown flight, world or light, a flight that does not
  /// fit into the world, a start outside the room, a rate or duration that gives no image, a lens
  /// that folds
  explicit WorldSequence(const WorldOptions& options);

  std::string name() const override { return options_.flight; }
  std::size_t size() const override { return truth_.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return truth_.poses()[index].stamp_ns; }
  cv::Mat image(std::size_t index) override;
  const CameraIntrinsics& camera() const override { return options_.camera; }
  Eigen::Isometry3d T_base_cam() const override { return options_.T_base_cam; }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<OdometryState>& odometry() const override { return odometry_.states; }
  std::vector<RangeReading> ranges() const override { return ranges_; }

  /// That the odometry drew; 0 without one.
  OdometryNote odometryNote() const override {
    if (!options_.odometry) return {};
    return {options_.odometry->name, options_.seed, odometry_.scale_error};
  }
  const WorldOptions& options() const { return options_; }
  /// What the drone does and what is around it; seconds count from the first image.
  const Flight& flight() const { return *flight_; }
  const World& world() const { return world_; }

 private:
  double seconds(std::size_t index) const { return static_cast<double>(index) / options_.rate_hz; }
  Eigen::Isometry3d T_body_base() const {
    return options_.T_body_cam * options_.T_base_cam.inverse();
  }
  Eigen::Isometry3d T_world_base(double t_s) const;
  void flyTruth();

  WorldOptions options_;
  std::unique_ptr<const Flight> flight_;
  World world_;
  WorldCamera camera_;
  Trajectory truth_;
  OdometryRun odometry_;
  std::vector<RangeReading> ranges_;
};

}  // namespace ardrone_vslam
