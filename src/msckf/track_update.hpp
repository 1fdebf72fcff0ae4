// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "ardrone_vslam/msckf_config.hpp"
#include "msckf/track_residual.hpp"
#include "window/track_window.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// A used track: its point may become a landmark.
struct UsedTrack {
  FinishedTrack track;          ///< its views are good until the window's tracks are asked again
  TrackPoint point;             ///< by all its views
  std::uint32_t anchor_id = 0;  ///< the frame whose error the point shares
  /// Of the point beside its anchor, by the noise of the rays and the errors of the frames.
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  /// Share by which the odometry's velocity error may have stretched the baseline.
  double stretch_sigma = 0;
};

/// Corrects the window by the tracks that are complete (the MSCKF's feature update): each
/// constrains, once, the frames that saw it. Wrong ones are found by a gate and by consensus.
class TrackUpdate {
 public:
  /// @param config  is taken as valid: the filter that holds it has checked it
  explicit TrackUpdate(const MsckfConfig& config) : config_(config) {}

  /// The next frames are another camera's; tracks that were not used yet are still the old one's.
  /// @param camera_rig  the old camera's position in the rig
  void changeCamera(const Eigen::Vector3d& camera_rig);
  /// No track of another camera is left.
  void forgetEarlierCamera() { earlier_camera_rig_.reset(); }
  /// A frame without an update.
  void skip();

  /// Corrects the state. Of each used track the window keeps the newest view alone.
  /// O(tracks x views^2 + coordinates^3).
  /// @param finished  tracks of the window
  /// @param camera_rig  the camera's position in the rig
  /// @param focal_length_px  of the newest frame
  /// @param anchor_id  Clone::id, in the window, of the frame that new points belong to
  void apply(const std::vector<FinishedTrack>& finished, const Eigen::Vector3d& camera_rig,
             double focal_length_px, std::uint32_t anchor_id, TrackWindow& tracks,
             WindowState& state);

  /// The tracks used by the last apply(), of this frame.
  const std::vector<UsedTrack>& used() const { return used_; }
  /// Tracks that had enough parallax, likewise.
  int candidates() const { return candidates_; }
  /// Squared deviations of those that passed the gate over what the covariance says of them before
  /// the correction, likewise: 1 is honest; 0 when there was none.
  double nis() const { return nis_; }
  /// Median distance of the points used last; 0: none yet, or another camera's.
  double pointDistance_m() const { return point_distance_m_; }

 private:
  struct Candidate;

  std::vector<Candidate> gate(const std::vector<FinishedTrack>& finished,
                              const Eigen::Vector3d& camera_rig, const WindowState& state);
  bool correct(std::vector<Candidate>& candidates, double focal_length_px,
               WindowState& state) const;
  void collectUsed(const std::vector<Candidate>& candidates, const Eigen::Vector3d& camera_rig,
                   std::uint32_t anchor_id, TrackWindow& tracks, const WindowState& state);

  MsckfConfig config_;
  std::optional<Eigen::Vector3d> earlier_camera_rig_;  // whose tracks are left in the window
  std::vector<UsedTrack> used_;
  int candidates_ = 0;
  double nis_ = 0;
  double point_distance_m_ = 0;
};

}  // namespace ardrone_vslam
