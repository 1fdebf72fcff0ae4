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

/// Of the angles between a measured ray and a landmark, across the ray.
/// @param along, beside  unit, across the landmark's direction and each other
/// @param slack_rad  sigma of the attitude
inline Eigen::Matrix2d acrossCovariance_rad2(const MapObservation& observation,
                                             const Eigen::Vector3d& along,
                                             const Eigen::Vector3d& beside, double distance_m,
                                             double sigma_a, double slack_rad) {
  Eigen::Matrix<double, 3, 2> axes;
  axes << along, beside;
  axes /= distance_m;
  return (sigma_a * sigma_a + slack_rad * slack_rad) * Eigen::Matrix2d::Identity() +
         axes.transpose() * observation.covariance_m2 * axes;
}

/// The product of its two sigmas.
/// @param offset  of the landmark from the camera
inline double acrossSigmas_rad2(const MapObservation& observation, const Eigen::Vector3d& offset,
                                double sigma_a, double slack_rad) {
  const Eigen::Vector3d along = offset.unitOrthogonal();
  const Eigen::Vector3d beside = offset.normalized().cross(along);
  return std::sqrt(
      acrossCovariance_rad2(observation, along, beside, offset.norm(), sigma_a, slack_rad)
          .determinant());
}

/// Squared deviations between a ray and a landmark seen from a camera position; where they are more
/// than kInlier, a lower bound. A landmark's depth was known worse than its direction: seen from
/// elsewhere, it may be far off along one axis, and not along the other.
inline double offRay(const MapObservation& observation, const Eigen::Vector3d& ray_map,
                     const Eigen::Vector3d& camera_map, double sigma_a, double slack_rad) {
  const Eigen::Vector3d offset = observation.point_map - camera_map;
  const double distance_m = offset.norm();
  constexpr double kFar = 1e9;
  if (!(ray_map.dot(offset) > 0)) return kFar;
  const Eigen::Vector3d direction = offset / distance_m;
  const Eigen::Vector3d normal = ray_map.cross(direction);  // its length is the angle's sine
  const double squared_rad2 = normal.squaredNorm();
  // Along no axis is the variance more than of all axes together.
  const double at_least =
      squared_rad2 / (sigma_a * sigma_a + slack_rad * slack_rad +
                      observation.covariance_m2.trace() / (distance_m * distance_m));
  if (at_least >= kInlier || squared_rad2 == 0) return at_least;
  const Eigen::Vector3d beside = normal / std::sqrt(squared_rad2);
  const Eigen::Matrix2d covariance_rad2 = acrossCovariance_rad2(
      observation, beside.cross(direction), beside, distance_m, sigma_a, slack_rad);
  return squared_rad2 * covariance_rad2(1, 1) / covariance_rad2.determinant();
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
