// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
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

class WindowState;

/// Takes all of a flight's state into the frame of an earlier one's map.
class MapEntrance {
 public:
  explicit MapEntrance(WindowState& state) : state_(state) {}
  /// The flight is moved, and the map's anchors join, ahead of the others. The flight's errors from
  /// now on have those of the anchor that it was found by. O(coordinates^2).
  void enter(const MapEntry& entry, const LoadedAnchors& loaded);

 private:
  void move(const MapEntry& entry);
  void share(const MapEntry& entry, std::size_t loaded);

  WindowState& state_;
};

}  // namespace ardrone_vslam
