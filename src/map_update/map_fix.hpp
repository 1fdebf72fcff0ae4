// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "window/window_state.hpp"

namespace ardrone_vslam {

/// A landmark of an earlier visit, matched in the newest frame.
struct MapObservation {
  Eigen::Vector3d bearing_rig = Eigen::Vector3d::UnitX();  ///< measured unit ray
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();     ///< where the map has it
  Eigen::Matrix3d covariance_m2 =
      Eigen::Matrix3d::Zero();  ///< beside what its anchor's errors cause
  std::size_t anchor = 0;       ///< index into WindowState::anchors()
  std::size_t index = 0;        ///< among the frame's observations
  double window_rad = M_PI;     ///< it was looked for so far around its prediction
};

/// The observations that agree on one pose of base, and which.
struct ObservationConsensus {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();   ///< of base
  Eigen::Matrix3d R_map_rig = Eigen::Matrix3d::Identity();  ///< as predicted, or as found
  std::vector<MapObservation> observations;                 ///< those that agree
};

/// Random sample consensus over pairs: with the attitude known two rays give the position. The
/// samples are the same in every run. O(samples x observations).
/// @param angle_sigma_rad  sigma_a of a ray
ObservationConsensus agreeOnPosition(const Clone& predicted, const Eigen::Vector3d& camera_rig,
                                     const std::vector<MapObservation>& observations,
                                     double angle_sigma_rad);

/// A correction of the newest pose by landmarks, as information on that pose, on the anchors and
/// the scale.
struct MapFix {
  Information information;                 ///< what WindowState::update() is to be given
  Vector6d offset = Vector6d::Zero();      ///< of the pose: position, attitude
  Matrix6d covariance = Matrix6d::Zero();  ///< of the offset, by the landmarks' and rays' noise
  Matrix6d drift = Matrix6d::Zero();       ///< what the filter expects of the offset

  /// The offset in sigmas of what the filter expects of it.
  Vector6d whitened() const;
  /// offset' (drift + covariance)^-1 offset, chi-square with six degrees of freedom.
  double distance() const;
};

/// What became of the landmarks of earlier visits that a frame shows.
enum class FixOutcome {
  kNone,       ///< too few of them agree
  kNotNeeded,  ///< they agree with the pose, whose drift since the last fix is too small to matter
  kApplied,    ///< they corrected the pose
  kRelocated,  ///< applied, by landmarks found in wide windows
  kRejected    ///< they disagree with the pose by more than the gate
};

/// Fewer landmarks of earlier visits that agree give no fix: three fix a pose, three more say that
/// they are no mistake.
constexpr int kFewestFixLandmarks = 6;

/// @param independent  the landmarks' errors are alike in groups: their fix is not taken as better
/// than so many independent ones make it
MapFix fixBy(const WindowState& state, const Eigen::Vector3d& camera_rig,
             const ObservationConsensus& consensus, double angle_sigma_rad, int independent);

/// How well the newest attitude is known relative to the observed landmarks' anchors, per axis.
double attitudeSigma_rad(const std::vector<MapObservation>& observations, const WindowState& state);

/// Of the windows that they were looked for in, the median.
double medianWindow_rad(const std::vector<MapObservation>& observations);

}  // namespace ardrone_vslam
