// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/level_pose.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"

namespace ardrone_vslam {

std::vector<LevelPose> posesOfPair(const Eigen::Vector3d& ray_a, const Eigen::Vector3d& point_a,
                                   const Eigen::Vector3d& ray_b, const Eigen::Vector3d& point_b) {
  constexpr double kLevel = 1e-3;  // of a ray, its height
  const Eigen::Vector3d between = point_a - point_b;
  // Depths d on the line  height . d = between.z:  d = nearest + t * along.
  const Eigen::Vector2d height(ray_a.z(), -ray_b.z());
  const double steepness2 = height.squaredNorm();
  if (!(steepness2 > kLevel * kLevel) || between.head<2>().isZero()) return {};
  const Eigen::Vector2d nearest = height * (between.z() / steepness2);
  const Eigen::Vector2d along = Eigen::Vector2d(-height.y(), height.x()) / std::sqrt(steepness2);
  Eigen::Matrix2d level;
  level << ray_a.head<2>(), -ray_b.head<2>();
  const Eigen::Vector2d u = level * along;
  const Eigen::Vector2d v = level * nearest;
  // |v + t u|^2 = |between.xy|^2
  const double a = u.squaredNorm();
  const double b = u.dot(v);
  const double root2 = b * b - a * (v.squaredNorm() - between.head<2>().squaredNorm());
  if (!(a > kLevel * kLevel) || !(root2 >= 0)) return {};
  std::vector<LevelPose> poses;
  for (const double sign : {1.0, -1.0}) {
    const double t = (-b + sign * std::sqrt(root2)) / a;
    const Eigen::Vector2d depths_m = nearest + t * along;
    if (!(depths_m.minCoeff() > 0)) continue;
    const Eigen::Vector2d seen = v + t * u;
    LevelPose pose;
    pose.heading_rad =
        portable::atan2(between.y(), between.x()) - portable::atan2(seen.y(), seen.x());
    pose.camera_map = point_a - depths_m.x() * (rotationAboutZ(pose.heading_rad) * ray_a);
    poses.push_back(pose);
    if (root2 == 0) break;
  }
  return poses;
}

}  // namespace ardrone_vslam
