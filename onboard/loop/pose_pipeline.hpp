// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardrone_vslam/setup_monitor.hpp"
#include "ardrone_vslam/slam.hpp"
#include "ardrone_vslam/tracker.hpp"
#include "input/frame_source.hpp"
#include "loop/flight_map.hpp"
#include "loop/observer_states.hpp"
#include "stamps/stamp_guard.hpp"

namespace ardrone_vslam {

/// Tracker and Slam as the nodelets compose them, without input and output: an image's features
/// wait for the observer's state at its exposure.
class PosePipeline {
 public:
  /// @param maps  of the flight before, and of this one
  /// @throws ConfigError, std::invalid_argument, MapFileError
  PosePipeline(const TrackerConfig& tracker, const SlamConfig& slam, const CameraIntrinsics& camera,
               const Eigen::Isometry3d& T_base_cam, FlightMap::Files maps);

  /// @return whether the frame is used: its stamp is after the one before, and no single one far
  /// from all others (StampGuard). When time begins again the map begins anew.
  bool track(const Frame& frame);
  bool isWaiting() const { return waiting_since_ns_.has_value(); }
  /// Gives the waiting frame up.
  void forgetFrame() { waiting_since_ns_.reset(); }
  /// Memory has run out: gives map, waiting frame and observer states up, and begins anew, without
  /// a loaded map.
  void startOverEmpty();

  /// What the images are localised with.
  ObserverStates& observer() { return observer_; }
  const ObserverStates& observer() const { return observer_; }

  enum class Answer {
    kPose,
    kNotYet,  ///< the observer's state may still come
    kNever    ///< it cannot: the frame is given up
  };
  /// For the waiting frame.
  Answer localise();

  const CameraModel& cameraModel() const { return tracker_.camera(); }
  const FrameResult& result() const { return *result_; }
  const ImageFeatures& features() const { return features_; }
  const SetupMonitor& setup() const { return setup_; }
  const Landmarks& landmarks() const { return slam_->landmarks(); }
  int restarts() const { return restarts_; }
  /// Between two frames. @copydetails FlightMap::saveInFlight()
  void saveInFlight(std::int64_t now_ns) { map_.saveInFlight(*slam_, now_ns); }
  /// @copydoc FlightMap::saveAtEnd()
  std::string saveAtEnd() { return map_.saveAtEnd(*slam_); }

 private:
  void beginFlight();
  void startOver();

  SlamConfig config_;
  Eigen::Isometry3d T_base_cam_;
  Tracker tracker_;
  FlightMap map_;
  std::optional<Slam> slam_;
  ObserverStates observer_;
  SetupMonitor setup_;
  ImageFeatures features_;
  const FrameResult* result_ = nullptr;
  StampGuard stamps_;
  std::optional<std::int64_t> waiting_since_ns_;  // the waiting frame's begin, in processor time
  int restarts_ = 0;
};

}  // namespace ardrone_vslam
