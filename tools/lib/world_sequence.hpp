// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "observer_model.hpp"
#include "sequence.hpp"
#include "world_flight.hpp"
#include "world_renderer.hpp"

namespace ardrone_vslam {

/// The AR.Drone's front camera as its driver states it: 640x360.
CameraIntrinsics arDroneFrontCamera();
/// T_body_cam of that camera: 0.21 m before the middle of the drone.
Eigen::Isometry3d arDroneFrontMount();

/// What make_world renders.
struct WorldOptions {
  std::string flight = "laps";
  double duration_s = 60;
  double rate_hz = 30;  ///< of the images
  /// The observer's profile; nothing: the sequence has no observer.
  std::optional<ObserverProfile> observer;
  std::optional<double> range_noise_m;  ///< nothing: the sequence has no ranges
  std::uint64_t seed = 0;               ///< noise of the observer, the ranges and the images
  std::uint64_t world_seed = 0;         ///< the room
  std::optional<FlightStart> start;
  /// Where base is: the camera always flies at arDroneFrontMount(), so arDroneFrontMount() makes
  /// base the middle of the drone and forwardCamera() the camera's own position.
  Eigen::Isometry3d T_base_cam = arDroneFrontMount();
  CameraIntrinsics camera = arDroneFrontCamera();
  double image_noise_grey = 2;
};

/// A synthetic flight: rendered images, exact truth at each image, simulated observer. Stamps begin
/// at 1 s (ROS takes 0 for "none"). Images may be asked for in any order and often.
class WorldSequence : public Sequence {
 public:
  /// Paints the room: takes about a second.
  /// @throws std::invalid_argument for an unknown flight, a start outside the room, a rate or
  /// duration that gives no image, a lens that folds
  explicit WorldSequence(const WorldOptions& options);

  std::string name() const override { return options_.flight; }
  std::size_t size() const override { return truth_.size(); }
  std::int64_t stamp_ns(std::size_t index) const override { return truth_.poses()[index].stamp_ns; }
  cv::Mat image(std::size_t index) override;
  const CameraIntrinsics& camera() const override { return options_.camera; }
  Eigen::Isometry3d T_base_cam() const override { return options_.T_base_cam; }
  const Trajectory& truth() const override { return truth_; }
  const std::vector<ObserverState>& observer() const override { return observer_.states; }
  std::vector<RangeReading> ranges() const override { return ranges_; }

  /// That the observer drew; 0 without one.
  ObserverNote observerNote() const override {
    if (!options_.observer) return {};
    return {options_.observer->name, options_.seed, observer_.scale_error};
  }
  const WorldOptions& options() const { return options_; }

 private:
  WorldOptions options_;
  Scene room_;
  WorldRenderer renderer_;
  Trajectory truth_;
  ObserverRun observer_;
  std::vector<RangeReading> ranges_;
};

}  // namespace ardrone_vslam
