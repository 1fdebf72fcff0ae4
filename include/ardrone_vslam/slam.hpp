// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/landmark_map.hpp"
#include "ardrone_vslam/observer_buffer.hpp"
#include "ardrone_vslam/slam_config.hpp"
#include "ardrone_vslam/stages.hpp"

/// The library: from images and odometry to a pose and a map, without ROS and OpenCV.
namespace ardrone_vslam {

/// What a frame's pose rests on; `explain` gives the sentence for users.
enum class SlamState {
  kBuildingMap,      ///< no landmark can be in view yet: the pose is the observer's
  kLocalised,        ///< landmarks corrected the pose
  kTooFewLandmarks,  ///< fewer matches than `min_landmarks`: the pose is the observer's increment
  kFixRejected,   ///< the landmarks' position failed its gate: the pose is the observer's increment
  kObserverOnly,  ///< `estimator: observer`
  kNotFinite,     ///< a number overflowed: the pose is not to be used, the map is to begin anew
  kTracking,      ///< constraint filter: tracks correct the pose, no place seen before is in view
  kResting,       ///< constraint filter: the image is still and holds the position
  kRotating,      ///< constraint filter: the camera turns on the spot, the image holds the position
  kRelocated,     ///< constraint filter: as kLocalised, by landmarks looked for nearly everywhere
  kDistrusted,    ///< constraint filter: camera and odometry contradict each other, the pose is the
                  ///< observer's (Watchdog)
};
/// As in Status and frames.csv, by the enumerators' order.
constexpr std::array<const char*, 11> kSlamStateNames{
    "building_map", "localised", "too_few_landmarks", "fix_rejected", "observer_only", "not_finite",
    "tracking",     "resting",   "rotating",          "relocated",    "distrusted"};

/// One frame's answer.
struct FrameResult {
  std::int64_t stamp_ns = 0;                                     ///< the image's
  SlamState state = SlamState::kBuildingMap;                     ///< what the pose rests on
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< fused
  Eigen::Isometry3d T_odom_base =
      Eigen::Isometry3d::Identity();  ///< the observer's pose it started from
  Matrix6d covariance =
      Matrix6d::Zero();    ///< of T_map_base: position [m^2], rotation vector [rad^2], axes of map
  double deviation_m = 0;  ///< of the fused position, per axis (6.12)
  /// Constraint filter: ConstraintFilter::fixNis(); 0 with the others.
  double fix_nis = 0;
  /// Constraint filter: of the observer, which reports (1 + error) times the way; 0 with the
  /// others.
  double scale_error = 0;
  double scale_deviation = 0;                   ///< standard deviation of scale_error
  HeightOutcome height = HeightOutcome::kNone;  ///< constraint filter
  /// By so much the observer's position jumped since the last frame; 0: it moved. The constraint
  /// filter does not take it for a way.
  double odometry_step_m = 0;
  /// Base position by the landmarks alone, before the fusion (6.4); nothing when there were too
  /// few.
  std::optional<Eigen::Vector3d> camera_position_map;
  double camera_deviation_m = 0;  ///< of camera_position_map, per axis

  MatchMethod match_method = MatchMethod::kGuided;  ///< how landmarks were looked for
  int features = 0;                                 ///< in the image
  int landmarks_in_view = 0;    ///< landmarks that the prediction puts into the image
  int landmark_candidates = 0;  ///< landmark matches before the removal of mismatches
  int landmark_matches = 0;     ///< and after
  /// Feature-map matches before the removal of mismatches; constraint filter: tracks with parallax.
  int feature_candidates = 0;
  int feature_matches = 0;    ///< and after; constraint filter: tracks used
  int new_landmarks = 0;      ///< made by this frame
  int removed_landmarks = 0;  ///< dropped by it: never confirmed, failing, or over the cap
  int landmarks = 0;          ///< in the map, after this frame
  int map_features = 0;       ///< in the feature map, after this frame
};

/// Whether every number of the pose, of its covariance and of T_map_odom is finite.
bool isFinite(const FrameResult& result);

constexpr double kFarthestCamera_m = 100;  ///< from base

/// What cannot be the mounting of a camera, and what helps; empty when it can.
std::string mountingFault(const Eigen::Isometry3d& T_base_cam);

/// Features and observer states -> fused poses and a map (thesis algorithm 5; where it departs from
/// that: docs/data_path.md).
class Slam {
 public:
  /// @param T_base_cam  mounting of the camera: optical frame to base
  /// @throws ConfigError listing every invalid parameter; std::invalid_argument with the
  /// mountingFault
  Slam(const SlamConfig& config, const Eigen::Isometry3d& T_base_cam);
  ~Slam();

  /// One frame. Stamps must ascend and the observer state must be for the image's stamp (asserted).
  /// At the first frame map equals odom. After kNotFinite every further answer may be that.
  const FrameResult& process(const ImageFeatures& features, const ObserverState& observer,
                             const StageHook& hook = {});

  /// The next frame is another camera's, on the same base (or the camera's calibration is another
  /// one): the map goes on, and pose and odometry with it. Its features must have new tracks.
  /// @throws std::invalid_argument with the mountingFault
  /// @pre canChangeCamera() (asserted)
  void changeCamera(const Eigen::Isometry3d& T_base_cam);

  /// False with `mounting_deviation_deg`, which is the error of one camera's mounting.
  bool canChangeCamera() const;

  /// The map, up to the last frame.
  const LandmarkMap& landmarks() const;
  /// Takes the memory for max_landmarks, and for those that one image adds before the oldest go.
  void reserveMap();
  /// REP-105: corrects the odometry's drift. Identity until the first correction.
  Eigen::Isometry3d T_map_odom() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A sentence for users: why the pose is only the observer's, and what helps.
const char* explain(SlamState state);

}  // namespace ardrone_vslam
