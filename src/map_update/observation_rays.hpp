// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "map_update/map_fix.hpp"

namespace ardrone_vslam {

constexpr double kInlier = 6;  // squared deviations of a ray's two angles, 95 %
/// Sigma of the predicted attitude, and of landmarks among each other, while agreement is
/// looked for.
constexpr double kSlack_rad = 0.005;

/// A small linear congruential generator: the same samples on every machine.
class Draws {
 public:
  std::size_t below(std::size_t count) {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<std::size_t>((static_cast<std::uint64_t>(state_) * count) >> 32);
  }

 private:
  std::uint32_t state_ = 12345;
};

/// Variance of the angle across the ray, per axis, between a measured ray and a landmark.
inline double acrossVariance_rad2(const MapObservation& observation,
                                  const Eigen::Vector3d& direction_map, double distance_m,
                                  double sigma_a, double slack_rad) {
  const double own_m2 = observation.covariance_m2.trace() -
                        direction_map.dot(observation.covariance_m2 * direction_map);
  return sigma_a * sigma_a + slack_rad * slack_rad + own_m2 / (distance_m * distance_m);
}

/// Squared deviations between a ray and a landmark seen from a camera position.
inline double offRay(const MapObservation& observation, const Eigen::Vector3d& ray_map,
                     const Eigen::Vector3d& camera_map, double sigma_a, double slack_rad) {
  const Eigen::Vector3d offset = observation.point_map - camera_map;
  const double distance_m = offset.norm();
  constexpr double kFar = 1e9;
  if (!(ray_map.dot(offset) > 0)) return kFar;
  const Eigen::Vector3d direction = offset / distance_m;
  return ray_map.cross(direction).squaredNorm() /
         acrossVariance_rad2(observation, direction, distance_m, sigma_a, slack_rad);
}

/// The camera position from which two landmarks are seen along two rays, nearly.
inline Eigen::Vector3d nearestToRays(const MapObservation& a, const Eigen::Vector3d& ray_a,
                                     const MapObservation& b, const Eigen::Vector3d& ray_b) {
  const Eigen::Matrix3d across_a = Eigen::Matrix3d::Identity() - ray_a * ray_a.transpose();
  const Eigen::Matrix3d across_b = Eigen::Matrix3d::Identity() - ray_b * ray_b.transpose();
  return Eigen::Matrix3d(across_a + across_b)
      .ldlt()
      .solve(across_a * a.point_map + across_b * b.point_map);
}

}  // namespace ardrone_vslam
