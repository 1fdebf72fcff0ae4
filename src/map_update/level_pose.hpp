// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ardrone_vslam {

/// A camera of known roll and pitch.
struct LevelPose {
  double heading_rad = 0;  ///< turns its level axes to those of the map
  Eigen::Vector3d camera_map = Eigen::Vector3d::Zero();
};

/// The poses, at most two, from which two points are seen along two rays, roll and pitch known: the
/// depths a, b along the rays fulfil  R_z (a ray_a - b ray_b) = point_a - point_b, whose height is
/// linear and whose length is quadratic in them. (The problem is that of Kukelova, Bujnak and
/// Pajdla, ACCV 2010, for a calibrated camera.) None where the rays' heights say nothing: both rays
/// are level, or the points stand above each other. O(1).
/// @param ray_a, ray_b  unit, axes of a level frame: z is the map's
std::vector<LevelPose> posesOfPair(const Eigen::Vector3d& ray_a, const Eigen::Vector3d& point_a,
                                   const Eigen::Vector3d& ray_b, const Eigen::Vector3d& point_b);

}  // namespace ardrone_vslam
