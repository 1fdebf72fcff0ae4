// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/msckf_config.hpp"
#include "heights/height_update.hpp"
#include "map_update/innovation_consistency.hpp"
#include "map_update/map_fix.hpp"
#include "matching/frame_view.hpp"
#include "msckf/re_anchoring.hpp"
#include "msckf/track_residual.hpp"
#include "msckf/track_window.hpp"
#include "msckf/watchdog.hpp"
#include "msckf/window_state.hpp"
#include "zero_motion/zero_motion_detector.hpp"

namespace ardrone_vslam {

/// A landmark as seen by the newest frame.
struct LandmarkObservation {
  Eigen::Vector3d bearing_base = Eigen::Vector3d::UnitX();  ///< measured unit ray
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();      ///< where the map has it
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Landmark::covariance_m2
  std::uint32_t anchor_id = 0;                              ///< Landmark::anchor_id
  double window_rad = M_PI;  ///< it was looked for so far around its prediction
};

/// What a fix makes of a observation.
enum class ObservationVerdict {
  kUnjudged,     ///< nothing: a young landmark, or there was no fix
  kAgrees,       ///< with an accepted fix
  kContradicts,  ///< an accepted fix
  kDoubtful      ///< found in a wide window, and no fix says that it is right
};

/// A used track: its point may become a landmark.
struct UsedTrack {
  FinishedTrack track;          ///< its views are good until the next track()
  TrackPoint point;             ///< by all its views
  std::uint32_t anchor_id = 0;  ///< the frame whose error the point shares
  /// Of the point beside its anchor, by the noise of the rays and the errors of the frames.
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  /// Share by which the odometry's velocity error may have stretched the baseline.
  double stretch_sigma = 0;
};

/// Fuses the odometry with the camera: every track constrains, once, the frames that saw it,
/// without a landmark in the state; landmarks of earlier visits correct the drift since, and are
/// themselves taken along with what is corrected; while the image is still and no such landmark is
/// in view, the camera is held where it is; heights above the floor tell the scale. Between
/// keyframes all but the tracks are applied.
class Msckf {
 public:
  /// @throws ConfigError listing every parameter out of its range
  Msckf(const MsckfConfig& config, const Eigen::Isometry3d& T_base_cam);

  /// The first frame: map equals odom there.
  void start(const OdometryState& odometry);
  /// The next frame is another camera's, on the same base: tracks end, all else goes on.
  void changeCamera(const Eigen::Isometry3d& T_base_cam);
  /// The next frame, by the odometry's increment. @param step  of that: no way (OdometryStep)
  void predict(const OdometryState& odometry,
               const std::optional<OdometryStep>& step = std::nullopt);
  /// Corrects the newest pose by landmarks of earlier visits, once the drift since is worth it.
  FixOutcome fix(const std::vector<LandmarkObservation>& observations, double focal_length_px);
  /// Of the observations given to the last fix().
  const std::vector<ObservationVerdict>& verdicts() const { return verdicts_; }
  /// Takes in the newest frame's tracks; at a keyframe uses those that are complete.
  /// @return the tracks used, good until the next call
  const std::vector<UsedTrack>& track(const ImageFeatures& features);
  /// A track belongs to a landmark.
  void assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id) {
    tracks_.assignLandmark(track_id, landmark_id);
  }

  /// How the landmarks are to be moved, after fix() and track().
  std::vector<AnchorCorrection> takeMoves(double focal_length_px);
  /// How well the newest pose is known relative to each anchor, ascending in its id.
  std::vector<AnchorDrift> drifts() const;

  /// The newest frame, the mounting's error included: see WindowState.
  const Clone& newest() const { return state_.frames().back(); }
  /// Of base: newest() without the mounting's error.
  Eigen::Isometry3d T_map_base() const;
  /// Of T_map_base: position [m^2], rotation vector [rad^2], axes of map.
  Matrix6d covariance() const;
  /// Mean and covariance of all that is estimated.
  const WindowState& state() const { return state_; }
  /// Of the odometry: it reports (1 + error) times the way.
  double scaleError() const { return state_.scaleError(); }
  /// Standard deviation of scaleError().
  double scaleSigma() const;
  /// Of the last frame's height.
  HeightOutcome heightOutcome() const { return height_outcome_; }
  /// Of the last frame: tracks with enough parallax.
  int candidates() const { return candidates_; }
  /// Whether the newest frame is a keyframe.
  bool isKeyframe() const { return newest_is_keyframe_; }
  /// Those of candidates() that agreed and were used.
  int used() const { return static_cast<int>(used_.size()); }
  /// Squared deviations of the fixes over what the covariance says of them, mean of the last ten or
  /// so: 1 is honest.
  double fixNis() const { return consistency_.nis(); }
  /// The camera contradicts the odometry: for now the pose is the odometry's.
  bool isDistrustful() const { return watchdog_.isDistrustful(newest().stamp_ns); }
  /// Of the last frame, by its image; moving where the odometry contradicts it.
  CameraMotion motion() const { return motion_; }

 private:
  /// What the rays of tracks need of the camera that saw them.
  struct TrackCamera {
    Eigen::Vector3d camera_base;
    double sigma_a;  // deviation of a ray [rad]
  };

  FixOutcome fixByObservations(const std::vector<LandmarkObservation>& observations,
                               double sigma_a);
  FixOutcome fixByFew(const std::vector<MapObservation>& observations, double sigma_a);
  FixOutcome fixByMost(const std::vector<MapObservation>& observations, double sigma_a);
  FixOutcome apply(const ObservationConsensus& consensus, double sigma_a, double gate_sigmas);
  void judge(const std::vector<MapObservation>& observations,
             const ObservationConsensus& consensus);
  double attitudeSigma_rad(const std::vector<MapObservation>& observations) const;
  /// Coordinates of a pose that a fix may find wrong.
  int fixCoordinates() const { return config_.attitude_states ? 6 : 3; }
  void watchForContradiction();
  void forgetCamera();
  void watchForRest(const ImageFeatures& features);
  bool holdStill(std::size_t reference);
  /// Where nothing else tells the drift: the camera has moved by no more than the image shows in a
  /// scene that is rest_depth_m away, so a hovering drone stays though its odometry drifts.
  void holdToScene(const ImageFeatures& features);
  /// The way since a frame of the window is not longer than this across the view.
  void limitDisplacement(std::size_t frame, double across_m);
  /// How well the turn since a frame of the window is known, per axis.
  double rotationSigma_rad(std::size_t frame) const;
  /// By landmarks of earlier visits.
  bool isLocated() const;
  void makeReference();
  void forgetReference();
  std::optional<std::size_t> frameOf(std::uint32_t id) const;
  bool isKeyframe(const ImageFeatures& features);
  bool hasKnownBaseline(TrackViews views) const;
  double stretchSigma(TrackViews views, const Eigen::Vector3d& camera_base) const;
  /// With `floor_points`, of a track that ends below.
  std::optional<FloorHeight> floorOf(TrackViews views) const;
  void chooseAnchor();
  void useTracks(const std::vector<FinishedTrack>& finished, const TrackCamera& camera);
  void dropOldest();
  void joinAnchors();
  std::optional<std::size_t> anchorOf(std::uint32_t anchor_id) const;

  MsckfConfig config_;
  Eigen::Vector3d camera_base_;
  Eigen::Matrix3d R_base_cam_;
  WindowState state_;
  TrackOrder order_;  // of the newest frame's features
  TrackWindow tracks_;
  std::optional<TrackCamera> earlier_camera_;  // whose tracks are left in the window
  double sigma_a_ = 0;                         // of the tracks seen last [rad]
  ZeroMotionDetector rest_;
  CameraMotion motion_ = CameraMotion::kUnknown;
  FixOutcome fix_outcome_ = FixOutcome::kNone;  // of the newest frame
  std::vector<ObservationVerdict> verdicts_;
  HeightUpdate height_;
  std::optional<double> height_m_;  // at the newest frame
  HeightOutcome height_outcome_ = HeightOutcome::kNone;
  // The frame that stays in the window, keyframe or not, to compare the newest one with.
  std::uint32_t reference_id_ = 0;
  bool reference_is_keyframe_ = false;
  Eigen::Vector3d odometry_displacement_ = Eigen::Vector3d::Zero();  // while the camera is held
  std::uint32_t keyframe_id_ = 0;                                    // of the last keyframe
  bool newest_is_keyframe_ = false;
  std::vector<UsedTrack> used_;
  int candidates_ = 0;
  InnovationConsistency consistency_;
  bool fix_was_compared_ = false;  // at the newest frame
  Watchdog watchdog_;
  Eigen::Isometry3d trusted_T_map_odom_ = Eigen::Isometry3d::Identity();  // of the last calm frame
  std::uint32_t anchor_id_ = 0;                       // of the frame that new points belong to
  double point_distance_m_ = 0;                       // median of the last keyframe's points
  std::unordered_set<std::uint32_t> anchors_in_use_;  // frames of the window that points belong to
  ReAnchoring moves_;
};

}  // namespace ardrone_vslam
