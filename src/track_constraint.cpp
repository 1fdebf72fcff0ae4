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
                             const Eigen::Vector3d& camera_base, TrackViews views) {
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
                                           const Eigen::Vector3d& camera_base, TrackViews views,
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

Eigen::VectorXd TrackConstraint::change(const Eigen::VectorXd& error, int first) const {
  Eigen::VectorXd rows(residual.size());
  for (std::size_t i = 0; i < pose.size(); ++i)
    rows.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        pose[i] * error.segment<6>(coordinates[i] - first);
  rows -= point * (point.transpose() * rows).eval();
  return rows;
}

double TrackConstraint::distance(const WindowState& state) const {
  const auto P = state.covariance();
  Eigen::MatrixXd S(residual.size(), residual.size());  // A P A' + I, its lower half
  for (std::size_t i = 0; i < pose.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      S.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(j)) =
          pose[i] * P.block<6, 6>(coordinates[i], coordinates[j]) * pose[j].transpose();
    }
  }
  S.diagonal().array() += 1;
  // Across U the inverse is S^-1 - S^-1 U (U' S^-1 U)^-1 U' S^-1.
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> root(S);
  const Eigen::VectorXd r = root.matrixL().solve(residual);
  const Eigen::Matrix<double, Eigen::Dynamic, 3> U = root.matrixL().solve(point);
  const Eigen::Vector3d along = U.transpose() * r;
  return r.squaredNorm() - along.dot(Eigen::Matrix3d(U.transpose() * U).llt().solve(along));
}

void TrackConstraint::addTo(Information& information, double weight) const {
  const int first = information.coordinates.front();
  std::vector<Eigen::Matrix<double, 6, 3>> along(pose.size());  // A' U
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    const int at_i = coordinates[i] - first;
    along[i] = pose[i].transpose() * point.middleRows<2>(row);
    const Eigen::Matrix<double, 6, 2> weighted = weight * pose[i].transpose();
    information.matrix.block<6, 6>(at_i, at_i) += weighted * pose[i];
    information.vector.segment<6>(at_i) += weighted * residual.segment<2>(row);
    for (std::size_t j = 0; j <= i; ++j) {
      const int at_j = coordinates[j] - first;
      const Eigen::Matrix<double, 6, 6> taken = weight * along[i] * along[j].transpose();
      information.matrix.block<6, 6>(at_i, at_j) -= taken;
      if (j < i) information.matrix.block<6, 6>(at_j, at_i) -= taken.transpose();
    }
  }
}

std::optional<TrackConstraint> constraintOf(const WindowState& state,
                                            const Eigen::Vector3d& camera_base, TrackViews views,
                                            const TrackPoint& point, double angle_deviation_rad) {
  const auto n = static_cast<Eigen::Index>(views.size());
  TrackConstraint constraint;
  constraint.pose.reserve(views.size());
  constraint.coordinates.reserve(views.size());
  constraint.residual.resize(2 * n);
  Eigen::Matrix<double, Eigen::Dynamic, 3> on_point(2 * n, 3);
  for (const TrackView& view : views) {
    const auto ray =
        rayResidual(state.frames()[view.frame], camera_base, view.bearing_base, point.position_map);
    if (!ray) return std::nullopt;
    const auto row = 2 * static_cast<Eigen::Index>(constraint.pose.size());
    constraint.pose.push_back(ray->pose / angle_deviation_rad);
    constraint.coordinates.push_back(state.frameCoordinate(view.frame));
    constraint.residual.segment<2>(row) = ray->residual / angle_deviation_rad;
    on_point.middleRows<2>(row) = ray->point;
  }
  // The rows across the point's own Jacobian do not depend on where it is.
  const Eigen::HouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> qr(on_point);
  constraint.point.setIdentity(2 * n, 3);
  constraint.point.applyOnTheLeft(qr.householderQ());
  constraint.residual -=
      constraint.point * (constraint.point.transpose() * constraint.residual).eval();
  return constraint;
}

Eigen::Matrix3d covarianceByFrames(const WindowState& state, const Eigen::Vector3d& camera_base,
                                   TrackViews views, const Eigen::Vector3d& point_map,
                                   std::size_t anchor) {
  // Error of the point less that of a point which keeps its place beside the anchor = G e, e the
  // errors of bias, scale, anchor, and views.
  constexpr int kBeforeViews = 10;
  std::vector<int> coordinates;
  const auto include = [&coordinates](int first, int count) {
    for (int k = 0; k < count; ++k) coordinates.push_back(first + k);
  };
  include(WindowState::kBias, 4);
  include(state.frameCoordinate(anchor), WindowState::kFrame);
  Eigen::Matrix<double, 3, Eigen::Dynamic> G(
      3, kBeforeViews + WindowState::kFrame * static_cast<Eigen::Index>(views.size()));
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  auto column = kBeforeViews;
  for (const TrackView& view : views) {
    const auto ray =
        rayResidual(state.frames()[view.frame], camera_base, view.bearing_base, point_map);
    if (!ray) continue;
    A += ray->point.transpose() * ray->point;
    G.middleCols<6>(column) = ray->point.transpose() * ray->pose;
    include(state.frameCoordinate(view.frame), WindowState::kFrame);
    column += WindowState::kFrame;
  }
  G.conservativeResize(3, column);
  G.rightCols(column - kBeforeViews) = -(A.inverse() * G.rightCols(column - kBeforeViews)).eval();
  const WindowPose& pose = state.frames()[anchor];
  const Eigen::Vector3d from_anchor = point_map - pose.position_map;
  G.leftCols<3>() = from_anchor * pose.stretch_by_bias_s_m.transpose();
  G.col(3) = from_anchor;
  G.middleCols<3>(4) = -Eigen::Matrix3d::Identity();
  G.middleCols<3>(7) = skew(from_anchor);
  return G * state.covariance()(coordinates, coordinates) * G.transpose();
}

double chiSquare95(int degrees_of_freedom) {
  const double k = degrees_of_freedom;
  const double spread = 2 / (9 * k);
  constexpr double kNormal95 = 1.6449;
  const double root = 1 - spread + kNormal95 * std::sqrt(spread);
  return k * root * root * root;
}

}  // namespace ardrone_vslam
