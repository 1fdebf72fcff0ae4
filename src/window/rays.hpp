// SPDX-License-Identifier: BSD-3-Clause
// Points by measured rays, and how far rays are off predicted points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "window/clone.hpp"
#include "window/track_views.hpp"

namespace ardrone_vslam {

/// A point by all its views.
struct TrackPoint {
  Eigen::Vector3d position_map = Eigen::Vector3d::Zero();   ///< of the point
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< by the noise of the rays alone
  double parallax_rad = 0;                                  ///< largest angle to the first ray
  double ray_sigma_rad = 0;                                 ///< of a ray, in the mean
};

/// Where a measured ray lies beside the predicted one, and how that changes with the errors of pose
/// and point: residual = pose * (true pose - pose) + point * (true point - point), in the tangent
/// plane of the PREDICTED ray (Jacobians at measured rays bias the motion).
struct RayResidual {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();                      ///< [rad]
  Eigen::Matrix<double, 2, 6> pose = Eigen::Matrix<double, 2, 6>::Zero();  ///< position, attitude
  Eigen::Matrix<double, 2, 3> point =
      Eigen::Matrix<double, 2, 3>::Zero();  ///< derivative by the point [rad/m]
};

/// @param camera_rig  the camera's position in the rig
/// @return nothing when the point is at the camera or more than 60 degrees off the ray
std::optional<RayResidual> rayResidual(const Clone& pose, const Eigen::Vector3d& camera_rig,
                                       const Eigen::Vector3d& bearing_rig,
                                       const Eigen::Vector3d& point_map);
/// The same of a track's view, both rows of unit noise [1], [1/m].
std::optional<RayResidual> rayResidual(const Clone& pose, const Eigen::Vector3d& camera_rig,
                                       const TrackView& view, const Eigen::Vector3d& point_map);

/// The root for a ray known alike all around, and for one whose information is given along the
/// image's columns and rows.
/// @param sigma_rad  sigma of the ray's angle
RayRoot rayRoot(const Eigen::Vector3d& bearing, double sigma_rad);
RayRoot rayRoot(const Eigen::Vector3d& bearing_cam, const Eigen::Matrix2d& information_rad2);

/// Least-squares point of rays from given poses.
/// @return nothing for fewer than two views, parallel rays, or a point behind a camera
std::optional<TrackPoint> triangulateTrack(const std::vector<Clone>& frames,
                                           const Eigen::Vector3d& camera_rig, TrackViews views);

}  // namespace ardrone_vslam
