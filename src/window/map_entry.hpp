// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "window/clone.hpp"

namespace ardrone_vslam {

/// Where a flight has been found in the map of an earlier one. Gravity is down in both, so four
/// numbers are open: position and heading.
struct MapEntry {
  /// Takes what the flight has as map so far to the loaded map; turns about the vertical only.
  Eigen::Isometry3d T_loaded_flight = Eigen::Isometry3d::Identity();
  /// About this point of the loaded map the heading is uncertain: where the camera was.
  Eigen::Vector3d camera_loaded = Eigen::Vector3d::Zero();
  /// Of the loaded map's anchors, the one whose landmarks most of all say so: with its error
  /// position and heading err, too.
  std::size_t anchor = 0;
  /// Of that position [m] and of the heading [rad] beside that anchor, axes of the loaded map.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

/// How a pose errs with an anchor that it is known by: rows position and attitude, columns the
/// anchor's coordinates.
using PoseByAnchor = Eigen::Matrix<double, 6, 7>;
/// @param from_anchor  the pose's position beside that of the anchor, axes of map [m]
PoseByAnchor poseByAnchor(const Eigen::Vector3d& from_anchor);

/// The anchors of a loaded map.
struct LoadedAnchors {
  std::vector<Clone> anchors;
  Eigen::MatrixXd covariance;  ///< WindowState::kAnchor coordinates each
};

/// The flight has been found in its own map, elsewhere than it was thought to be.
struct Revisit {
  MapEntry entry;               ///< from where it was thought to be; `anchor` is not set
  std::uint32_t anchor_id = 0;  ///< Clone::id of the anchor whose landmarks most of all say so
  /// Poses before it stay where they are. Those from `to_ns` on move by all of the entry, and
  /// between the two by a share that grows evenly.
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::min();

  /// By which a pose moves, 0 to 1. Landmarks of an earlier flight stay.
  double shareOf(const Clone& pose) const;
};

class WindowState;

/// Takes a flight's state into the frame of an earlier one's map, or a part of it to another place
/// of its own.
class MapEntrance {
 public:
  explicit MapEntrance(WindowState& state) : state_(state) {}
  /// The flight is moved, and the map's anchors join, ahead of the others. The flight's errors from
  /// now on have those of the anchor that it was found by. O(coordinates^2).
  void enter(const MapEntry& entry, const LoadedAnchors& loaded);
  /// A part of the flight is moved within its own map. What was known of where it is beside the
  /// rest is forgotten: it errs with the anchor from now on. O(coordinates^2).
  /// As enter() does, it takes odometry for moved, too.
  /// @pre the state has the revisit's anchor (asserted)
  void shift(const Revisit& revisit);
  /// From that pose on all err by so much more, as one piece. O(coordinates^2).
  /// @param covariance  position of the newest and attitude, axes of map
  void doubtSince(std::int64_t since_ns, const Eigen::Matrix<double, 6, 6>& covariance);

 private:
  void move(const Revisit& revisit);
  void loosen(const Revisit& revisit);
  void share(const Revisit& revisit, const Eigen::MatrixXd& D);
  Eigen::MatrixXd cameraBy(std::uint32_t id, const MapEntry& entry) const;

  WindowState& state_;
};

}  // namespace ardrone_vslam
