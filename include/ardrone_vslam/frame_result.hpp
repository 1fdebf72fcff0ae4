// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

/// How the landmarks of a frame were looked for.
enum class MatchMethod {
  kGuided,  ///< those that the prediction puts into the image, in a window about it
  kExact,   ///< every feature compared with every landmark
  kIndexed  ///< every feature looked up in the index of all landmarks
};
template <>
struct EnumNames<MatchMethod> {
  static constexpr std::array<const char*, 3> kNames{"guided", "exact", "indexed"};
};

/// What became of a frame's height.
enum class HeightOutcome {
  kNone,      ///< there was none, or the last one used is too young
  kApplied,   ///< corrects the pose, and the scale as the height changes
  kRejected,  ///< disagrees with the floor
  kNewFloor,  ///< the first one, or the floor is another one now: it tells where that is
};

/// What a frame's pose rests on; `explain` gives the sentence for users.
enum class SlamState {
  // "Landmarks" are those of earlier visits. With MSCKF tracks correct the pose all the same.
  kBuildingMap,      ///< no landmark can be in view yet
  kLocalised,        ///< landmarks corrected the pose, or agreed with it so well that none was due
  kTooFewLandmarks,  ///< thesis: fewer matches than `min_landmarks`
  kFixRejected,      ///< the landmarks' position failed its gate and corrected nothing
  kOdometryOnly,     ///< `estimator: odometry`
  kNotFinite,        ///< a number overflowed: no pose to be used; Slam::process() goes on anew
  kTracking,         ///< MSCKF: tracks correct the pose, no place seen before is in view
  kResting,          ///< MSCKF: the image is still and holds the position
  kRotating,         ///< MSCKF: the camera turns on the spot, the image holds the position
  kRelocated,        ///< MSCKF: as kLocalised, by landmarks looked for nearly everywhere
  kDistrusted,       ///< camera and odometry contradict each other, the pose is the odometry's
  kSearchingMap,     ///< MSCKF: the flight has not been found in its map yet
  kBlind,            ///< MSCKF: no track corrected the pose, and hardly one goes on
};
/// As in Status and frames.csv, by the enumerators' order.
constexpr std::array<const char*, 13> kSlamStateNames{
    "building_map",  "localised",  "too_few_landmarks", "fix_rejected",
    "observer_only", "not_finite", "tracking",          "resting",
    "rotating",      "relocated",  "distrusted",        "searching_map",
    "blind"};
constexpr int kFewestFeatures = 8;  ///< fewer tell neither a motion nor that there is none

/// One frame's answer.
struct FrameResult {
  std::int64_t stamp_ns = 0;                                     ///< the image's
  SlamState state = SlamState::kBuildingMap;                     ///< what the pose rests on
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< fused
  Eigen::Isometry3d T_odom_base =
      Eigen::Isometry3d::Identity();  ///< the odometry's pose it started from
  Matrix6d covariance =
      Matrix6d::Zero();  ///< of T_map_base: position [m^2], rotation vector [rad^2], axes of map
  double sigma_m = 0;    ///< of the fused position, per axis (6.12)
  /// MSCKF: Msckf::fixNis(); 0 with the others.
  double fix_nis = 0;
  /// MSCKF: squared deviations of this frame's tracks that passed their gate, over what the
  /// covariance says of them; 1 is honest, 0 when there was none.
  double track_nis = 0;
  /// MSCKF: the odometry's slow velocity error as it is counted with, per axis: `velocity_bias_m_s`
  /// and what was learned since; 0 with the others.
  double velocity_bias_sigma_m_s = 0;
  /// MSCKF: drift of its yaw as learned, over `yaw_walk_deg_per_sqrt_s` and `_m`; 0 likewise.
  double yaw_walk_factor = 0;
  /// MSCKF: of the odometry, which reports (1 + error) times the way; 0 with the others.
  double scale_error = 0;
  double scale_sigma = 0;                       ///< standard deviation of scale_error
  HeightOutcome height = HeightOutcome::kNone;  ///< MSCKF
  /// By so much the odometry's position jumped since the last frame; 0: it moved. The MSCKF
  /// does not take it for motion.
  double odometry_step_m = 0;
  /// MSCKF: so far from where it was thought to be the camera has been found in the flight's own
  /// map; 0: it is where it was thought to be, as far as is known.
  double revisit_m = 0;
  /// Of base, by the landmarks alone (6.4): shown beside the fused one; nothing when there were too
  /// few.
  std::optional<Eigen::Vector3d> landmark_position_map;
  double landmark_sigma_m = 0;  ///< of landmark_position_map, per axis

  bool is_keyframe = false;                         ///< MSCKF: its pose stays in the window
  MatchMethod match_method = MatchMethod::kGuided;  ///< how landmarks were looked for
  int features = 0;                                 ///< in the image
  int tracks = 0;                                   ///< features that carry on a track
  int tracks_aligned = 0;       ///< of them, those with a position between pixels
  int landmarks_in_view = 0;    ///< landmarks that the prediction puts into the image
  int landmark_candidates = 0;  ///< landmark matches before the removal of mismatches
  int landmark_matches = 0;     ///< and after
  /// Feature-map matches before the removal of mismatches; MSCKF: tracks with parallax.
  int feature_candidates = 0;
  int feature_matches = 0;    ///< and after; MSCKF: tracks used
  int new_landmarks = 0;      ///< made by this frame
  int removed_landmarks = 0;  ///< dropped by it: never confirmed, failing, or over the cap
  int landmarks = 0;          ///< in the map, after this frame
  int map_features = 0;       ///< in the feature map, after this frame
  LeftOut left_out;           ///< what `frame_budget_ms` left this frame no time for
};

/// Whether every number of the pose, of its covariance and of T_map_odom is finite.
bool isFinite(const FrameResult& result);

/// A sentence for users: why the pose is only the odometry's, and what helps.
const char* explain(SlamState state);

/// A sentence for users, of FrameResult::revisit_m.
std::string explainRevisit(double revisit_m);

/// A sentence for users. @param odometry  its subject, such as "the odometry on /odom"
std::string explainStep(const std::string& odometry, double step_m);

}  // namespace ardrone_vslam
