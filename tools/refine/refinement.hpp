// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "ardrone_vslam/flight_record.hpp"
#include "ardrone_vslam/saved_map.hpp"
#include "refine/track_points.hpp"

namespace ardrone_vslam {

/// What all of a flight says about its way and its points.
struct Refinement {
  std::vector<Eigen::Isometry3d> T_map_base;  ///< of the record's keyframes
  /// The error of the camera's extrinsics at each: the rig is base, turned by it.
  std::vector<Eigen::Matrix3d> R_base_rig;
  /// Of the last one, per axis of base, where anchor_covariance is known and it was estimated.
  std::optional<Eigen::Vector3d> extrinsics_sigma_rad;
  std::vector<TrackPoint3d> points;
  /// SavedMap::anchor_covariance of the anchors that were named; empty where it cannot be told, or
  /// there are more than 1500 keyframes.
  Eigen::MatrixXd anchor_covariance;
  std::size_t views = 0;           ///< that count
  std::size_t views_left_out = 0;  ///< as they, or others of their point, contradict the rest
};

/// Told from time to time how much of the work is done, from 0 to 1; about, as nobody knows how
/// many iterations it takes.
using RefinementProgress = std::function<void(double share)>;

/// Bundle adjustment (Triggs et al., 2000) of the keyframes' poses and all points at once, by their
/// views, the odometry with the errors that the MSCKF believes it has, those of the extrinsics, and
/// heights. The scale is that of odometry and heights. The map stays where its first keyframe is.
/// O(views) an iteration, and what the keyframes' sparse system takes.
/// @param anchors  of the flight's map: how well each is known is that of the keyframe before it
/// @return nothing of a record without keyframes
/// @throws std::runtime_error when the solver fails, or too few views agree
Refinement refine(const FlightRecord& record, const std::vector<MapAnchor>& anchors = {},
                  const RefinementProgress& progress = {});

}  // namespace ardrone_vslam
