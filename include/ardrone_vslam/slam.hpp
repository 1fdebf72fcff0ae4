// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/setup_watch.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "ardrone_vslam/stages.hpp"

/// The library: from images and odometry to a pose and a map, without ROS and OpenCV.
namespace ardrone_vslam {

constexpr double kFarthestCamera_m = 100;  ///< from base

/// What extrinsics cannot be, and what helps; empty when it can.
std::string extrinsicsFault(const Eigen::Isometry3d& T_base_cam);

/// Features and odometry states -> fused poses and a map, by the estimator that the configuration
/// names (docs/msckf.md; of the thesis's algorithm 5: docs/thesis_estimator.md).
class Slam {
 public:
  /// @param T_base_cam  extrinsics: optical frame to base
  /// @throws ConfigError listing every invalid parameter; std::invalid_argument with the
  /// extrinsicsFault
  Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);
  ~Slam();

  /// One frame. Stamps must ascend and the odometry state must be for the image's stamp (asserted).
  /// At the first frame map equals odom. With another OdometryState::start than before, and after
  /// kNotFinite, MSCKF looks for the flight in its own map, as after load(). After kNotFinite the
  /// other estimators begin the map anew.
  /// @param clock  of this frame, for `frame_budget_ms`; empty: nothing is left out
  const FrameResult& process(const ImageFeatures& features, const OdometryState& odometry,
                             const StageHook& hook = {}, const FrameClock& clock = {});

  /// What a SetupWatch says at the next frame. With a fault, poses are the odometry's, the state is
  /// kDistrusted, and with MSCKF the map keeps only what was made until the set-up was last
  /// confirmed. With forgets_images it keeps nothing, and that one frame is kDistrusted.
  void heed(const SetupFinding& finding);

  /// The next frame is another camera's, on the same base (or the camera's calibration is another
  /// one): the map goes on, and pose and odometry with it. Its features must have new tracks.
  /// `extrinsics_sigma_deg` is the error of each.
  /// @throws std::invalid_argument with the extrinsicsFault
  void changeCamera(const Eigen::Isometry3d& T_base_cam);

  /// The flight takes place in this map, where it is looked for from the first frame on. Until it
  /// is found (FrameResult::state kSearchingMap) the pose is beside a map of its own, and its
  /// covariance says that the place is unknown.
  /// @throws std::invalid_argument with the faultOfMaps
  /// @pre there was no frame yet (asserted)
  void load(SavedMap map);
  /// Looks for the flight near where base is said to be next. @throws as load(), or without a map
  void lookNear(const PlaceHint& hint);
  /// Whether there is a map in which the flight has not been found.
  bool isSearching() const;
  /// Whether save() has the flight's map: not while the flight is looked for in a loaded one.
  bool hasWholeMap() const;
  /// The map for a file, up to the last frame. While the flight is looked for in a loaded one it is
  /// what was made meanwhile; while in its own, that one: then O(landmarks), else
  /// O(coordinates^2 + landmarks / 256).
  /// @throws std::invalid_argument with the faultOfMaps
  MapSnapshot save() const;

  /// The map, up to the last frame.
  const Landmarks& landmarks() const;
  /// Another cap of the map, and budget, from the next frame on. @throws ConfigError
  void limit(const LandmarkMapConfig& landmark_map, const FrameBudgetConfig& frame_budget);
  /// Takes the memory for LandmarkMapConfig::most(), and for what one image adds before some go.
  void reserveMap();
  /// REP-105: corrects the odometry's drift. Identity until the first correction.
  Eigen::Isometry3d T_map_odom() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ardrone_vslam
