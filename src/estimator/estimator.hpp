// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "ardrone_vslam/setup_watch.hpp"
#include "estimator/frame_budget.hpp"
#include "map/association.hpp"
#include "map/landmark_locator.hpp"
#include "map/landmark_map.hpp"
#include "matching/frame_view.hpp"
#include "odometry/odometry_step.hpp"
#include "window/map_entry.hpp"

namespace ardrone_vslam {

/// The camera as an estimator has it: where it is, and how far landmarks may be off from there.
struct CameraPose {
  Eigen::Isometry3d T_map_cam = Eigen::Isometry3d::Identity();
  double position_variance_m2 = 0;  ///< of the position, per axis
  bool common_drift = true;         ///< landmarks share the drift of the time they were made
  std::vector<AnchorDrift> drifts;  ///< beside each anchor of landmarks, ascending in its id
};

/// What an estimator knows at a frame.
struct Estimate {
  Eigen::Isometry3d T_map_base = Eigen::Isometry3d::Identity();  ///< the pose
  Matrix6d covariance = Matrix6d::Zero();       ///< of T_map_base, see FrameResult::covariance
  double fix_nis = 0;                           ///< see FrameResult::fix_nis
  double track_nis = 0;                         ///< see FrameResult::track_nis
  double velocity_bias_sigma_m_s = 0;           ///< see FrameResult::velocity_bias_sigma_m_s
  double yaw_walk_factor = 0;                   ///< see FrameResult::yaw_walk_factor
  double scale_error = 0;                       ///< see FrameResult::scale_error
  double scale_sigma = 0;                       ///< its standard deviation
  HeightOutcome height = HeightOutcome::kNone;  ///< what became of the frame's height
  double doubtful_way_m = 0;  ///< of late, on which the image's tracks contradict the odometry
};

/// What the landmarks found in a frame did to the pose.
struct Correction {
  SlamState state = SlamState::kBuildingMap;  ///< what the pose rests on
  std::optional<PositionFix> by_landmarks;    ///< base by the landmarks alone, without prediction
  /// MSCKF: of the landmarks that the pose agrees with, enough for a fix were made by then.
  std::optional<std::int64_t> known_since_ns;
};

/// What updateMap() did to the map, and to what the pose rests on.
struct MapChanges {
  int new_landmarks = 0;  ///< see FrameResult, as the following ones
  int removed_landmarks = 0;
  int feature_candidates = 0;
  int feature_matches = 0;
  int map_features = 0;
  bool is_keyframe = false;
  std::optional<SlamState> state;  ///< what the pose rests on now; else as corrected
};

/// Makes poses and a map of odometry, landmark matches and tracks. Slam calls, for each frame,
/// predict, correct and updateMap, in this order; the last two only while the estimate is finite.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// The frame's pose by the odometry alone. At the first frame map equals odom.
  /// @param step  a jump in the odometry's increment since the last frame
  virtual void predict(const OdometryState& odometry, const std::optional<OdometryStep>& step) = 0;
  /// The camera after what has been called last. Not const: anchors it names count from then on.
  virtual CameraPose camera() = 0;
  /// Whether correct() would look at landmarks found now.
  virtual bool wantsLandmarks() const { return true; }
  /// Corrects the pose by landmarks. @param matches  of the map, in the view from camera()
  virtual Correction correct(const AssociationResult& matches, const FrameView& view,
                             const LandmarkMap& map) = 0;
  /// Corrects the pose by a still image, a height and the frame's tracks, in this order, and then
  /// changes the map.
  /// @param view  that of correct(); is moved to the pose that the map is changed from
  /// @param budget  OptionalWork::kKeyframe is taken from it where one is due
  virtual MapChanges updateMap(const AssociationResult& matches, FrameView& view, LandmarkMap& map,
                               FrameBudget& budget) = 0;
  /// After what has been called last.
  virtual Estimate estimate() const = 0;

  /// What is known of the set-up at the next frame. While it has a fault the pose is the
  /// odometry's; what the camera said since it was last confirmed is taken back, where that can be.
  virtual void heed(const SetupFinding& finding) = 0;
  /// Where the flight is in a loaded map, of which it then goes on; between predict() and
  /// correct(). Uses both up. @pre the estimator keeps anchors, as faultOfMaps() asks for
  virtual void enterMap(MapEntry&& entry, SavedMap&& loaded, const FrameView& view,
                        LandmarkMap& map);
  /// The flight is elsewhere in its own map; as enterMap(). Landmarks made meanwhile go along.
  /// @return false: now it cannot be done
  virtual bool shift(const Revisit& revisit, const FrameView& view, LandmarkMap& map);
  /// The map as it is, for a file, but for its camera. @pre as enterMap()
  virtual MapSnapshot save(const LandmarkMap& map) const;
  /// The next frame is another camera's, on the same base.
  virtual void changeCamera(const Eigen::Isometry3d& T_base_cam) = 0;
};

/// Moves the view's rays to a camera's position, with its uncertainty; their directions stay.
void moveTo(CameraPose camera, FrameView& view);

}  // namespace ardrone_vslam
