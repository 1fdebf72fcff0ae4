// SPDX-License-Identifier: BSD-3-Clause
#include "window/rays.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/landmark.hpp"
#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

/// Two unit vectors across a unit vector, as rows.
Eigen::Matrix<double, 2, 3> tangents(const Eigen::Vector3d& direction) {
  int least = 0;
  direction.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 2, 3> rows;
  rows.row(0) = direction.cross(Eigen::Vector3d::Unit(least)).normalized().transpose();
  rows.row(1) = direction.cross(rows.row(0).transpose()).transpose();
  return rows;
}

/// Where a point lies beside a measured ray.
struct Prediction {
  Eigen::Vector3d direction;  // from the camera to the point
  double distance_m;
  double along;  // cosine to the measured ray
};

std::optional<Prediction> predict(const Ray& measured, const Eigen::Vector3d& point_map) {
  constexpr double kNearest_m = 1e-6;
  constexpr double kWidestCosine = 0.5;  // 60 degrees off: behind, or of another point
  const Eigen::Vector3d offset = point_map - measured.origin_map;
  const double distance_m = offset.norm();
  if (!(distance_m > kNearest_m)) return std::nullopt;
  const Eigen::Vector3d direction = offset / distance_m;
  const double along = measured.direction_map.dot(direction);
  if (!(along > kWidestCosine)) return std::nullopt;
  return Prediction{direction, distance_m, along};
}

/// A ray of a track, and how well it is known.
struct KnownRay {
  Ray ray;
  RayRoot root_map;
};

/// The point nearest to all rays, a start for the iteration on angles.
Eigen::Vector3d nearestPoint(const std::vector<KnownRay>& rays) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const auto& [ray, root_map] : rays) {
    const Eigen::Matrix3d plane = acrossOf(ray.direction_map);
    A += plane;
    b += plane * ray.origin_map;
  }
  return A.inverse() * b;
}

/// Rows of unit noise in the tangent plane of a direction.
RayRoot across(const RayRoot& root_map, const Eigen::Vector3d& direction_map) {
  return root_map - root_map * direction_map * direction_map.transpose();
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return portable::atan2(a.cross(b).norm(), a.dot(b));
}

/// @param rowsAcross  gives the two rows, across the predicted direction, that residuals are taken
/// in
template <class RowsAcross>
std::optional<RayResidual> residualIn(const RowsAcross& rowsAcross, const Clone& pose,
                                      const Eigen::Vector3d& camera_rig,
                                      const Eigen::Vector3d& bearing_rig,
                                      const Eigen::Vector3d& point_map) {
  const Eigen::Vector3d lever = pose.R_map_rig * camera_rig;
  const Ray measured{pose.position_map + lever, pose.R_map_rig * bearing_rig};
  const auto predicted = predict(measured, point_map);
  if (!predicted) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> B = rowsAcross(predicted->direction);
  RayResidual ray;
  ray.residual = B * measured.direction_map / predicted->along;
  ray.point = B / predicted->distance_m;
  ray.pose.leftCols<3>() = -ray.point;
  ray.pose.rightCols<3>() = B * skew(predicted->direction) + ray.point * skew(lever);
  return ray;
}

}  // namespace

std::optional<RayResidual> rayResidual(const Clone& pose, const Eigen::Vector3d& camera_rig,
                                       const Eigen::Vector3d& bearing_rig,
                                       const Eigen::Vector3d& point_map) {
  return residualIn(tangents, pose, camera_rig, bearing_rig, point_map);
}

std::optional<RayResidual> rayResidual(const Clone& pose, const Eigen::Vector3d& camera_rig,
                                       const TrackView& view, const Eigen::Vector3d& point_map) {
  const RayRoot root_map = view.root_rig * pose.R_map_rig.transpose();
  const auto rowsAcross = [&root_map](const Eigen::Vector3d& direction_map) {
    return across(root_map, direction_map);
  };
  return residualIn(rowsAcross, pose, camera_rig, view.bearing_rig, point_map);
}

RayRoot rayRoot(const Eigen::Vector3d& bearing, double sigma_rad) {
  return tangents(bearing) / sigma_rad;
}

RayRoot rayRoot(const Eigen::Vector3d& bearing_cam, const Eigen::Matrix2d& information_rad2) {
  RayRoot axes;
  axes.row(0) = acrossOf(bearing_cam).col(0).normalized().transpose();
  axes.row(1) = bearing_cam.cross(axes.row(0).transpose()).transpose();
  return information_rad2.llt().matrixU() * axes;
}

std::optional<TrackPoint> triangulateTrack(const std::vector<Clone>& frames,
                                           const Eigen::Vector3d& camera_rig, TrackViews views) {
  if (views.size() < 2) return std::nullopt;
  std::vector<KnownRay> rays;
  rays.reserve(views.size());
  TrackPoint point;
  for (const TrackView& view : views) {
    const Clone& frame = frames[view.frame];
    rays.push_back(
        {{frame.position_map + frame.R_map_rig * camera_rig, frame.R_map_rig * view.bearing_rig},
         view.root_rig * frame.R_map_rig.transpose()});
    point.ray_sigma_rad += std::sqrt(2 / view.root_rig.squaredNorm());
  }
  point.ray_sigma_rad /= static_cast<double>(views.size());
  point.position_map = nearestPoint(rays);
  Eigen::Matrix3d inverse;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    // Of the residuals of rayResidual().
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const auto& [ray, root_map] : rays) {
      const auto predicted = predict(ray, point.position_map);
      if (!predicted) return std::nullopt;
      const RayRoot R = across(root_map, predicted->direction) / predicted->distance_m;
      A += R.transpose() * R;
      b += R.transpose() * (R * ray.direction_map) * (predicted->distance_m / predicted->along);
    }
    inverse = A.inverse();
    point.position_map += inverse * b;
    if (!point.position_map.allFinite()) return std::nullopt;
  }
  point.covariance_m2 = inverse;
  if (!point.covariance_m2.allFinite()) return std::nullopt;
  const Eigen::Vector3d first = point.position_map - rays.front().ray.origin_map;
  for (const auto& [ray, root_map] : rays) {
    const Eigen::Vector3d offset = point.position_map - ray.origin_map;
    if (!(offset.dot(ray.direction_map) > 0)) return std::nullopt;
    point.parallax_rad = std::max(point.parallax_rad, angleBetween(first, offset));
  }
  return point;
}

}  // namespace ardrone_vslam
