// SPDX-License-Identifier: BSD-3-Clause
#include "map/triangulation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "linear/portable_math.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSmallestBaseline_m = 1e-9;
constexpr double kSmallestSine = 1e-9;

/// Unit normal of the epipolar plane (p_1 - p_0) x s_0.
std::optional<Eigen::Vector3d> epipolarNormal(const Ray& first, const Ray& present) {
  const Eigen::Vector3d baseline = present.origin_map - first.origin_map;
  const Eigen::Vector3d normal = baseline.cross(first.direction_map);
  const double length = normal.norm();
  if (!(length > kSmallestBaseline_m) || !(length > kSmallestSine * baseline.norm()))
    return std::nullopt;
  return Eigen::Vector3d(normal / length);
}

}  // namespace

std::optional<TriangulatedPoint> triangulate(const Ray& first, const Ray& present) {
  const auto normal = epipolarNormal(first, present);
  if (!normal) return std::nullopt;
  Eigen::Vector3d s_1 =
      present.direction_map - present.direction_map.dot(*normal) * *normal;  // (5.18)
  if (!(s_1.norm() > kSmallestSine)) return std::nullopt;
  s_1.normalize();

  const Eigen::Vector3d& s_0 = first.direction_map;
  const Eigen::Vector3d baseline = present.origin_map - first.origin_map;
  const double sine =
      s_0.cross(s_1).dot(*normal);  // signed: positive when the rays converge (5.13)
  if (!(sine > kSmallestSine)) return std::nullopt;
  const double depth = baseline.cross(s_0).dot(*normal) / sine;  // u / sin(theta) (5.14, 5.15)
  const double first_depth =
      baseline.cross(s_1).dot(*normal) / sine;  // of the same point along the first ray
  if (!(depth > 0) || !(first_depth > 0)) return std::nullopt;

  TriangulatedPoint point;
  point.position_map = present.origin_map + depth * s_1;  // (5.16)
  point.depth_m = depth;
  point.parallax_rad = portable::atan2(sine, s_0.dot(s_1));
  return point;
}

std::optional<EpipolarOffset> epipolarOffset(const Ray& first, const Ray& present) {
  const auto normal = epipolarNormal(first, present);
  if (!normal) return std::nullopt;
  const Eigen::Vector3d motion = (present.origin_map - first.origin_map).normalized();
  return EpipolarOffset{std::abs(present.direction_map.dot(*normal)),
                        first.direction_map.cross(present.direction_map).dot(*normal),
                        motion.cross(present.direction_map).dot(*normal)};
}

double depthSigma_m(double sigma_m, double parallax_rad) {
  return sigma_m / std::max(portable::sin(parallax_rad), kSmallestSine);
}

}  // namespace ardrone_vslam
