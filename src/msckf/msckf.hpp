// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/msckf_config.hpp"
#include "estimator/frame_budget.hpp"
#include "heights/height_update.hpp"
#include "map_update/map_update.hpp"
#include "matching/track_order.hpp"
#include "msckf/anchors.hpp"
#include "msckf/track_update.hpp"
#include "msckf/watchdog.hpp"
#include "window/map_entry.hpp"
#include "window/propagator.hpp"
#include "window/track_window.hpp"
#include "window/window_state.hpp"
#include "zero_motion/zero_motion_update.hpp"

namespace ardrone_vslam {

/// Fuses the odometry with the camera. Each track corrects, once, the frames that saw it, without a
/// landmark in the state. Landmarks of earlier visits correct the drift since. While the image is
/// still the camera is held where it is. Heights above the floor tell the scale. Between keyframes
/// all but the tracks are applied. Each of these is a collaborator; this class is their order.
class Msckf {
 public:
  /// @throws ConfigError listing every parameter out of its range
  Msckf(const MsckfConfig& config, const Eigen::Isometry3d& T_base_cam);

  /// The first frame: map equals odom there.
  void start(const OdometryState& odometry);
  /// The next frame is another camera's, on the same base: tracks end, all else goes on.
  void changeCamera(const Eigen::Isometry3d& T_base_cam);
  /// What is known of the set-up at the next frame.
  void heed(const SetupFinding& finding) {
    watchdog_.heed(finding);
    propagator_.learnYaw(finding);
  }
  /// The next frame, by the odometry's increment. @param step  a jump in it, which is no motion
  void predict(const OdometryState& odometry,
               const std::optional<OdometryStep>& step = std::nullopt);
  /// Corrects the newest pose by landmarks of earlier visits, once the drift since is worth it.
  FixOutcome fix(const std::vector<LandmarkObservation>& observations, double focal_length_px);
  /// Of the observations given to the last fix().
  const std::vector<ObservationVerdict>& verdicts() const { return map_update_.verdicts(); }
  /// Holds a camera that stands still, takes in the newest frame's height and tracks, and at a
  /// keyframe uses the tracks that are complete.
  /// @param budget  a keyframe that is due waits for it
  /// @return the tracks used, good until the next call
  const std::vector<UsedTrack>& track(const ImageFeatures& features, FrameBudget& budget);
  /// A track belongs to a landmark.
  void assignLandmark(std::uint32_t track_id, std::uint32_t landmark_id) {
    tracks_.assignLandmark(track_id, landmark_id);
  }

  /// How the landmarks are to be moved, after fix() and track().
  std::vector<AnchorCorrection> takeCorrections(double focal_length_px) {
    return anchors_.takeCorrections(state_, track_update_.pointDistance_m(), focal_length_px);
  }

  /// The flight has been found in a loaded map: all of it moves there, and odometry is given in its
  /// frame from now on.
  void enterMap(const MapEntry& entry, const LoadedAnchors& loaded);
  /// The newest frame has been found elsewhere in the map: what came with it moves there, and
  /// odometry, too, as with enterMap(). @return false: now it cannot be done
  bool shift(const Revisit& revisit);

  /// The newest frame, the error of the extrinsics included: see WindowState.
  const Clone& newest() const { return state_.newest(); }
  /// Of base: newest() without the error of the extrinsics.
  Eigen::Isometry3d T_map_base() const { return state_.T_map_base(); }
  /// Of T_map_base: position [m^2], rotation vector [rad^2], axes of map.
  Matrix6d covariance() const { return state_.baseCovariance(); }
  /// Mean and covariance of all that is estimated.
  const WindowState& state() const { return state_; }
  /// Standard deviation of WindowState::scaleError().
  double scaleSigma() const {
    return std::sqrt(state_.covariance()(WindowState::kScale, WindowState::kScale));
  }
  /// Of the last frame's height.
  HeightOutcome heightOutcome() const { return height_.outcome(); }
  /// Of the last frame: tracks with enough parallax.
  int candidates() const { return track_update_.candidates(); }
  /// Those of candidates() that agreed and were used.
  int used() const { return static_cast<int>(track_update_.used().size()); }
  bool isKeyframe() const { return newest().id == tracks_.keyframeId(); }
  /// MapUpdate::nis().
  double fixNis() const { return map_update_.nis(); }
  /// TrackUpdate::nis(), of the last frame.
  double trackNis() const { return track_update_.nis(); }
  /// The odometry's noise that is in force.
  const LearnedNoise& learned() const { return propagator_.learned(); }
  /// The camera contradicts the odometry: for now the pose is the odometry's.
  bool isDistrustful() const { return watchdog_.isDistrustful(newest().stamp_ns); }
  /// Watchdog::doubtfulWay_m()
  double doubtfulWay_m() const { return watchdog_.doubtfulWay_m(); }
  /// Of the last frame, by its image; moving where the odometry contradicts it.
  CameraMotion motion() const { return zero_motion_.motion(); }

 private:
  void moveOdometry(const Eigen::Isometry3d& T_new_old);
  void watchForContradiction();
  void useStillness(const ImageFeatures& features);
  void useTracks(const ImageFeatures& features);
  bool needsKeyframe(const ImageFeatures& features);
  void dropOldest();

  MsckfConfig config_;
  Eigen::Isometry3d T_rig_cam_;
  WindowState state_;
  Propagator propagator_;
  TrackOrder order_;  // of the newest frame's features
  TrackWindow tracks_;
  TrackUpdate track_update_;
  MapUpdate map_update_;
  ZeroMotionUpdate zero_motion_;
  HeightUpdate height_;
  Anchors anchors_;
  Watchdog watchdog_;
};

}  // namespace ardrone_vslam
