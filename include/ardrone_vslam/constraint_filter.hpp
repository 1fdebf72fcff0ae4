// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "ardrone_vslam/anchor_moves.hpp"
#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/fix_consistency.hpp"
#include "ardrone_vslam/frame_view.hpp"
#include "ardrone_vslam/height_update.hpp"
#include "ardrone_vslam/map_fix.hpp"
#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/rest_detector.hpp"
#include "ardrone_vslam/track_constraint.hpp"
#include "ardrone_vslam/track_window.hpp"
#include "ardrone_vslam/watchdog.hpp"
#include "ardrone_vslam/window_state.hpp"

namespace ardrone_vslam {

/// What the filter believes of odometry, rays and landmarks, and when it uses them.
struct ConstraintFilterConfig {
  ObserverNoiseConfig observer;
  bool attitude_states = true;
  double track_deviation_px = 1;
  double track_common_px = 0.7;
  int window_frames = 12;
  double keyframe_px = 15;
  double keyframe_s = 2;
  int min_track_views = 3;
  double track_parallax_deviations = 6;
  double baseline_uncertainty = 0.5;
  double landmark_deviation = 0.2;
  double anchor_spacing = 0.3;
  double anchor_turn_deg = 20;
  int max_anchors = 32;
  int min_fix_landmarks = 6;
  int fix_independent_landmarks = 10;
  double fix_min_age_s = 3;
  double fix_drift_share = 1;
  double fix_gate_deviations = 2;
  double relocation_window_deg = 15;
  double relocation_gate_deviations = 5;
  RestConfig rest;
  WatchdogConfig watchdog;
  HeightConfig height;
};

template <class Visitor>
void visitParameters(ConstraintFilterConfig& c, Visitor&& visit) {
  visitParameters(c.observer, visit);
  visit(
      ParameterInfo{"attitude_states", "switch", 0, 0,
                    "constraint filter: estimate attitude errors; false: the cheaper linear form, "
                    "which takes the odometry's attitude and the mounting as exact"},
      c.attitude_states);
  visit(ParameterInfo{"track_deviation_px", "px", 0.01, 100,
                      "constraint filter: deviation of a track's rays"},
        c.track_deviation_px);
  visit(ParameterInfo{"track_common_px", "px", 0, 10000,
                      "what a keyframe's tracks err alike: together they are not taken as better"},
        c.track_common_px);
  visit(ParameterInfo{"window_frames", "frames", 3, 60,
                      "constraint filter: frames of the window; a long track spans so many"},
        c.window_frames);
  visit(
      ParameterInfo{"keyframe_px", "px", 0, 10000,
                    "the window keeps a frame when the image has moved so far since the last one, "
                    "its turning taken out, or when half of the tracks are lost"},
      c.keyframe_px);
  visit(ParameterInfo{"keyframe_s", "s", 0.001, 1e6, "or when so much time has passed"},
        c.keyframe_s);
  visit(ParameterInfo{"min_track_views", "frames", 2, 60,
                      "tracks with fewer views in the window are not used"},
        c.min_track_views);
  visit(ParameterInfo{"track_parallax_deviations", "-", 0, 1000,
                      "nor those with less parallax than this many deviations of a ray"},
        c.track_parallax_deviations);
  visit(ParameterInfo{"baseline_uncertainty", "-", 0.001, 1000,
                      "nor those whose baseline is less well known across than this share of it"},
        c.baseline_uncertainty);
  visit(ParameterInfo{"landmark_deviation", "-", 0.001, 1000,
                      "constraint filter: a track becomes a landmark when its point is known to "
                      "this share of its distance"},
        c.landmark_deviation);
  visit(
      ParameterInfo{"anchor_spacing", "-", 0.01, 100,
                    "landmarks share the error of the frame they belong to; a new one begins after "
                    "this share of the landmarks' distance"},
      c.anchor_spacing);
  visit(ParameterInfo{"anchor_turn_deg", "deg", 0.1, 180, "or after this turn"}, c.anchor_turn_deg);
  visit(ParameterInfo{"max_anchors", "frames", 1, 1000,
                      "so many such frames are told apart; the nearest ones become one beyond"},
        c.max_anchors);
  visit(ParameterInfo{"min_fix_landmarks", "landmarks", 4, 100000,
                      "fewer landmarks of earlier visits that agree give no fix"},
        c.min_fix_landmarks);
  visit(ParameterInfo{"fix_independent_landmarks", "landmarks", 1, 1000000,
                      "a fix is not taken as better than so many independent landmarks make it"},
        c.fix_independent_landmarks);
  visit(ParameterInfo{"fix_min_age_s", "s", 0, 1e6,
                      "younger landmarks share the present drift and give no fix"},
        c.fix_min_age_s);
  visit(
      ParameterInfo{"fix_drift_share", "-", 0, 1e6,
                    "a fix waits until the drift's variance is so many times its own, so that the "
                    "same landmarks do not count again and again"},
      c.fix_drift_share);
  visit(
      ParameterInfo{"fix_gate_deviations", "-", 0.5, 1e6,
                    "a fix that disagrees by more than this in the mean of its six coordinates is "
                    "rejected"},
      c.fix_gate_deviations);
  visit(ParameterInfo{"relocation_window_deg", "deg", 0.1, 180,
                      "of landmarks that were looked for further around their prediction a few may "
                      "fix the pose, "
                      "too, when more agree than chance can explain; else it takes most of all "
                      "that were found"},
        c.relocation_window_deg);
  visit(ParameterInfo{"relocation_gate_deviations", "-", 0.5, 1e6,
                      "fix_gate_deviations of such a fix: after a blind stretch the odometry has "
                      "often drifted more than it claims"},
        c.relocation_gate_deviations);
  visitParameters(c.rest, visit);
  visitParameters(c.watchdog, visit);
  visitParameters(c.height, visit);
}

/// A landmark as seen by the newest frame.
struct LandmarkSighting {
  Eigen::Vector3d bearing_base = Eigen::Vector3d::UnitX();  ///< measured unit ray
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();      ///< where the map has it
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Landmark::covariance_m2
  std::uint32_t anchor_id = 0;                              ///< Landmark::anchor_id
  double window_rad = M_PI;  ///< it was looked for so far around its prediction
};

/// What a fix makes of a sighting.
enum class SightingVerdict {
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
  double stretch_deviation = 0;
};

/// Fuses the observer with the camera: every track constrains, once, the frames that saw it,
/// without a landmark in the state; landmarks of earlier visits correct the drift since, and are
/// themselves taken along with what is corrected; while the image is still and no such landmark is
/// in view, the camera is held where it is; heights above the floor tell the scale. Between
/// keyframes all but the tracks are applied.
class ConstraintFilter {
 public:
  /// @throws ConfigError listing every parameter out of its range
  ConstraintFilter(const ConstraintFilterConfig& config, const Eigen::Isometry3d& T_base_cam);

  /// The first frame: map equals odom there.
  void start(const ObserverState& observer);
  /// The next frame is another camera's, on the same base: tracks end, all else goes on.
  void changeCamera(const Eigen::Isometry3d& T_base_cam);
  /// The next frame, by the observer's increment. @param step  of that: no way (OdometryStep)
  void predict(const ObserverState& observer,
               const std::optional<OdometryStep>& step = std::nullopt);
  /// Corrects the newest pose by landmarks of earlier visits, once the drift since is worth it.
  FixOutcome fix(const std::vector<LandmarkSighting>& sightings, double focal_length_px);
  /// Of the sightings given to the last fix().
  const std::vector<SightingVerdict>& verdicts() const { return verdicts_; }
  /// Takes in the newest frame's tracks; at a keyframe uses those that are complete.
  /// @return the tracks used, good until the next call
  const std::vector<UsedTrack>& track(const ImageFeatures& features);
  /// A track belongs to a landmark.
  void assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id) {
    tracks_.assignLandmark(track_id, landmark_id);
  }

  /// How the landmarks are to be moved, after fix() and track().
  std::vector<AnchorMove> takeMoves(double focal_length_px);
  /// How well the newest pose is known relative to each anchor, ascending in its id.
  std::vector<AnchorDrift> drifts() const;

  /// The newest frame, the mounting's error included: see WindowState.
  const WindowPose& newest() const { return state_.frames().back(); }
  /// Of base: newest() without the mounting's error.
  Eigen::Isometry3d T_map_base() const;
  /// Of T_map_base: position [m^2], rotation vector [rad^2], axes of map.
  Matrix6d covariance() const;
  /// Mean and covariance of all that is estimated.
  const WindowState& state() const { return state_; }
  /// Of the observer: it reports (1 + error) times the way.
  double scaleError() const { return state_.scaleError(); }
  /// Standard deviation of scaleError().
  double scaleDeviation() const;
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

  FixOutcome fixBySightings(const std::vector<LandmarkSighting>& sightings, double sigma_a);
  FixOutcome fixByFew(const std::vector<MapSighting>& sightings, double sigma_a);
  FixOutcome fixByMost(const std::vector<MapSighting>& sightings, double sigma_a);
  FixOutcome apply(const SightingConsensus& consensus, double sigma_a, double gate_deviations);
  void judge(const std::vector<MapSighting>& sightings, const SightingConsensus& consensus);
  double attitudeDeviation_rad(const std::vector<MapSighting>& sightings) const;
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
  void limitWay(std::size_t frame, double across_m);
  /// How well the turn since a frame of the window is known, per axis.
  double turnDeviation_rad(std::size_t frame) const;
  /// By landmarks of earlier visits.
  bool isLocated() const;
  void makeReference();
  void forgetReference();
  std::optional<std::size_t> frameOf(std::uint32_t id) const;
  bool isKeyframe(const ImageFeatures& features);
  bool hasKnownBaseline(TrackViews views) const;
  double stretchDeviation(TrackViews views, const Eigen::Vector3d& camera_base) const;
  /// With `floor_points`, of a track that ends below.
  std::optional<FloorHeight> floorOf(TrackViews views) const;
  void chooseAnchor();
  void useTracks(const std::vector<FinishedTrack>& finished, const TrackCamera& camera);
  void dropOldest();
  void joinAnchors();
  std::optional<std::size_t> anchorOf(std::uint32_t anchor_id) const;

  ConstraintFilterConfig config_;
  Eigen::Vector3d camera_base_;
  Eigen::Matrix3d R_base_cam_;
  WindowState state_;
  TrackOrder order_;  // of the newest frame's features
  TrackWindow tracks_;
  std::optional<TrackCamera> earlier_camera_;  // whose tracks are left in the window
  double sigma_a_ = 0;                         // of the tracks seen last [rad]
  RestDetector rest_;
  CameraMotion motion_ = CameraMotion::kUnknown;
  FixOutcome fix_outcome_ = FixOutcome::kNone;  // of the newest frame
  std::vector<SightingVerdict> verdicts_;
  HeightUpdate height_;
  std::optional<double> height_m_;  // at the newest frame
  HeightOutcome height_outcome_ = HeightOutcome::kNone;
  // The frame that stays in the window, keyframe or not, to compare the newest one with.
  std::uint32_t reference_id_ = 0;
  bool reference_is_keyframe_ = false;
  Eigen::Vector3d odometry_way_ = Eigen::Vector3d::Zero();  // while the camera is held
  std::uint32_t keyframe_id_ = 0;                           // of the last keyframe
  bool newest_is_keyframe_ = false;
  std::vector<UsedTrack> used_;
  int candidates_ = 0;
  FixConsistency consistency_;
  bool fix_was_compared_ = false;  // at the newest frame
  Watchdog watchdog_;
  Eigen::Isometry3d trusted_T_map_odom_ = Eigen::Isometry3d::Identity();  // of the last calm frame
  std::uint32_t anchor_id_ = 0;                       // of the frame that new points belong to
  double point_distance_m_ = 0;                       // median of the last keyframe's points
  std::unordered_set<std::uint32_t> anchors_in_use_;  // frames of the window that points belong to
  AnchorMoves moves_;
};

}  // namespace ardrone_vslam
