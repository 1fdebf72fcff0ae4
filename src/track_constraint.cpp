// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/track_constraint.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"

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

Eigen::Vector3d cameraOf(const WindowPose& pose, const Eigen::Vector3d& camera_base) {
  return pose.position_map + pose.R_map_base * camera_base;
}

/// The point nearest to all rays, a start for the iteration on angles.
Eigen::Vector3d nearestPoint(const std::vector<WindowPose>& frames,
                             const Eigen::Vector3d& camera_base,
                             const std::vector<TrackView>& views) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const TrackView& view : views) {
    const WindowPose& frame = frames[view.frame];
    const Eigen::Vector3d ray = frame.R_map_base * view.bearing_base;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    A += across;
    b += across * cameraOf(frame, camera_base);
  }
  return A.ldlt().solve(b);
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::optional<RayResidual> rayResidual(const WindowPose& pose, const Eigen::Vector3d& camera_base,
                                       const Eigen::Vector3d& bearing_base,
                                       const Eigen::Vector3d& point_map) {
  constexpr double kNearest_m = 1e-6;
  constexpr double kWidestCosine = 0.5;
  const Eigen::Vector3d lever = pose.R_map_base * camera_base;
  const Eigen::Vector3d offset = point_map - pose.position_map - lever;
  const double distance_m = offset.norm();
  if (!(distance_m > kNearest_m)) return std::nullopt;
  const Eigen::Vector3d predicted = offset / distance_m;
  const Eigen::Vector3d measured = pose.R_map_base * bearing_base;
  const double along = measured.dot(predicted);
  if (!(along > kWidestCosine)) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> B = tangents(predicted);
  RayResidual ray;
  ray.residual = B * measured / along;
  ray.point = B / distance_m;
  ray.pose.leftCols<3>() = -ray.point;
  ray.pose.rightCols<3>() = B * skew(predicted) + ray.point * skew(lever);
  return ray;
}

std::optional<TrackPoint> triangulateTrack(const std::vector<WindowPose>& frames,
                                           const Eigen::Vector3d& camera_base,
                                           const std::vector<TrackView>& views,
                                           double angle_deviation_rad) {
  if (views.size() < 2) return std::nullopt;
  TrackPoint point;
  point.position_map = nearestPoint(frames, camera_base, views);
  Eigen::Matrix3d A;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    A.setZero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const TrackView& view : views) {
      const auto ray =
          rayResidual(frames[view.frame], camera_base, view.bearing_base, point.position_map);
      if (!ray) return std::nullopt;
      A += ray->point.transpose() * ray->point;
      b += ray->point.transpose() * ray->residual;
    }
    point.position_map += A.ldlt().solve(b);
    if (!point.position_map.allFinite()) return std::nullopt;
  }
  point.covariance_m2 = angle_deviation_rad * angle_deviation_rad * A.inverse();
  if (!point.covariance_m2.allFinite()) return std::nullopt;
  const Eigen::Vector3d first =
      point.position_map - cameraOf(frames[views.front().frame], camera_base);
  for (const TrackView& view : views) {
    const WindowPose& frame = frames[view.frame];
    const Eigen::Vector3d offset = point.position_map - cameraOf(frame, camera_base);
    if (!(offset.dot(frame.R_map_base * view.bearing_base) > 0)) return std::nullopt;
    point.parallax_rad = std::max(point.parallax_rad, angleBetween(first, offset));
  }
  return point;
}

double TrackConstraint::distance(const WindowState& state) const {
  const Eigen::MatrixXd P = state.covariance()(coordinates, coordinates);
  Eigen::MatrixXd S = jacobian * P * jacobian.transpose();
  S.diagonal().array() += 1;
  return residual.dot(S.llt().solve(residual));
}

void TrackConstraint::addTo(Information& information, double weight) const {
  std::vector<int> to = coordinates;
  for (int& coordinate : to) coordinate -= information.coordinates.front();
  const Eigen::MatrixXd weighted = weight * jacobian.transpose();
  information.matrix(to, to) += weighted * jacobian;
  information.vector(to) += weighted * residual;
}

std::optional<TrackConstraint> constraintOf(const WindowState& state,
                                            const Eigen::Vector3d& camera_base,
                                            const std::vector<TrackView>& views,
                                            const TrackPoint& point, double angle_deviation_rad) {
  const auto n = static_cast<Eigen::Index>(views.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2 * n, 6 * n + 1);  // last column: the residual
  Eigen::Matrix<double, Eigen::Dynamic, 3> H_point(2 * n, 3);
  TrackConstraint constraint;
  for (Eigen::Index i = 0; i < n; ++i) {
    const TrackView& view = views[static_cast<std::size_t>(i)];
    const auto ray =
        rayResidual(state.frames()[view.frame], camera_base, view.bearing_base, point.position_map);
    if (!ray) return std::nullopt;
    H.block<2, 6>(2 * i, 6 * i) = ray->pose / angle_deviation_rad;
    H.block<2, 1>(2 * i, 6 * n) = ray->residual / angle_deviation_rad;
    H_point.middleRows<2>(2 * i) = ray->point;
    for (int k = 0; k < 6; ++k)
      constraint.coordinates.push_back(state.frameCoordinate(view.frame) + k);
  }
  // The rows across the point's own Jacobian do not depend on where it is.
  const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(H_point);
  H.applyOnTheLeft(qr.householderQ().adjoint());
  constraint.jacobian = H.bottomLeftCorner(2 * n - 3, 6 * n);
  constraint.residual = H.bottomRightCorner(2 * n - 3, 1);
  return constraint;
}

double chiSquare95(int degrees_of_freedom) {
  const double k = degrees_of_freedom;
  const double spread = 2 / (9 * k);
  constexpr double kNormal95 = 1.6449;
  const double root = 1 - spread + kNormal95 * std::sqrt(spread);
  return k * root * root * root;
}

}  // namespace ardrone_vslam
