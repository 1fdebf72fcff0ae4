// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/track_residual.hpp"

#include <Eigen/LU>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

/// Gives the rows of U orthonormal columns, of the same span (Gram and Schmidt, modified).
void orthonormalise(std::vector<ViewRows>& views) {
  for (int column = 0; column < 3; ++column) {
    double length2 = 0;
    for (const ViewRows& view : views) length2 += view.point.col(column).squaredNorm();
    const double length = std::sqrt(length2);
    Eigen::RowVector3d shared = Eigen::RowVector3d::Zero();
    for (ViewRows& view : views) {
      view.point.col(column) /= length;
      shared += view.point.col(column).transpose() * view.point;
    }
    for (ViewRows& view : views) {
      for (int other = column + 1; other < 3; ++other)
        view.point.col(other) -= shared(other) * view.point.col(column);
    }
  }
}

/// Cholesky decomposition S = L L' of the lower half of the upper square; what is below, as rows
/// that L is to be solved for, is taken along.
void decompose(Eigen::MatrixXd& lower) {
  for (Eigen::Index k = 0; k < lower.cols(); ++k) {
    const Eigen::Index rows = lower.rows() - k;
    lower.col(k).tail(rows) /= std::sqrt(lower(k, k));
    for (Eigen::Index j = k + 1; j < lower.cols(); ++j)
      lower.col(j).tail(lower.rows() - j) -= lower(j, k) * lower.col(k).tail(lower.rows() - j);
  }
}

}  // namespace

double TrackResidual::squaredRest(const Eigen::VectorXd& error, int first) const {
  const auto left = [&](const ViewRows& view) -> Eigen::Vector2d {
    return view.residual - view.pose * error.segment<6>(view.coordinate - first);
  };
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (const ViewRows& view : views) along += view.point.transpose() * left(view);
  double sum = 0;
  for (const ViewRows& view : views) sum += (left(view) - view.point * along).squaredNorm();
  return sum;
}

double TrackResidual::distance(const WindowState& state) const {
  const auto P = state.covariance();
  const auto n = 2 * static_cast<Eigen::Index>(views.size());
  Eigen::MatrixXd S(n + 4, n);  // A P A' + I, its lower half, and below it r' and U'
  Eigen::Index column = 0;
  for (auto right = views.begin(); right != views.end(); ++right, column += 2) {
    Eigen::Index row = column;
    for (auto left = right; left != views.end(); ++left, row += 2) {
      const Eigen::Matrix<double, 6, 2> P_A =
          P.block<6, 6>(left->coordinate, right->coordinate) * right->pose.transpose();
      S.block<2, 2>(row, column) = left->pose * P_A;
    }
    S.block<1, 2>(n, column) = right->residual.transpose();
    S.block<3, 2>(n + 1, column) = right->point.transpose();
  }
  S.diagonal().array() += 1;
  // Across U the inverse is S^-1 - S^-1 U (U' S^-1 U)^-1 U' S^-1.
  decompose(S);
  const Eigen::Matrix4d rest = S.bottomRows<4>() * S.bottomRows<4>().transpose();
  const Eigen::Vector3d along = rest.bottomLeftCorner<3, 1>();
  const Eigen::Matrix3d inverse = rest.bottomRightCorner<3, 3>().inverse();
  return rest(0, 0) - along.dot(inverse * along);
}

void TrackResidual::addTo(Information& information, double weight) const {
  const int first = information.coordinates.front();
  for (auto left = views.begin(); left != views.end(); ++left) {
    const int row = left->coordinate - first;
    const Eigen::Matrix<double, 6, 2> pose = weight * left->pose.transpose();
    const Eigen::Matrix<double, 6, 3> along = weight * left->along;
    information.vector.segment<6>(row) += pose * left->residual;
    information.matrix.block<6, 6>(row, row) += pose * left->pose;
    for (auto right = views.begin(); right <= left; ++right) {
      const Eigen::Matrix<double, 6, 6> block = along * right->along.transpose();
      information.matrix.block<6, 6>(row, right->coordinate - first) -= block;
      // A height and the view of its frame: both halves lie in one block of the diagonal.
      if (right != left && right->coordinate == left->coordinate)
        information.matrix.block<6, 6>(row, row) -= block.transpose();
    }
  }
}

std::optional<TrackResidual> residualOf(const WindowState& state, const Eigen::Vector3d& camera_rig,
                                        TrackViews views, const TrackPoint& point,
                                        const std::optional<FloorHeight>& floor) {
  TrackResidual track;
  track.views.reserve(views.size() + 1);
  for (const TrackView& view : views) {
    const auto ray = rayResidual(state.frames()[view.frame], camera_rig, view, point.position_map);
    if (!ray) return std::nullopt;
    ViewRows& rows = track.views.emplace_back();
    rows.coordinate = state.frameCoordinate(view.frame);
    rows.pose = ray->pose;
    rows.point = ray->point;
    rows.residual = ray->residual;
  }
  if (floor) {
    const Clone& frame = state.frames()[views.back().frame];
    ViewRows& rows = track.views.emplace_back();
    rows.coordinate = state.frameCoordinate(views.back().frame);
    rows.pose.setZero();
    rows.point.setZero();
    rows.pose(0, 2) = 1 / floor->sigma_m;
    rows.point(0, 2) = -1 / floor->sigma_m;
    const double height_m = frame.position_map.z() - point.position_map.z();
    rows.residual << (floor->height_m - height_m) / floor->sigma_m, 0;
    track.has_height = true;
  }
  orthonormalise(track.views);
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (const ViewRows& rows : track.views) along += rows.point.transpose() * rows.residual;
  for (ViewRows& rows : track.views) {
    rows.residual -= rows.point * along;
    rows.along = rows.pose.transpose() * rows.point;
  }
  return track;
}

Eigen::Matrix3d covarianceByFrames(const WindowState& state, const Eigen::Vector3d& camera_rig,
                                   TrackViews views, const Eigen::Vector3d& point_map,
                                   std::size_t anchor) {
  // Error of the point less that of a point which keeps its place beside the anchor = G e, e the
  // errors of bias, scale, anchor, and views: six columns of G each.
  struct Part {
    int coordinate;
    Eigen::Matrix<double, 3, 6> G;
  };
  std::vector<Part> parts;
  parts.reserve(views.size() + 2);
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (const TrackView& view : views) {
    const auto ray = rayResidual(state.frames()[view.frame], camera_rig, view, point_map);
    if (!ray) continue;
    A += ray->point.transpose() * ray->point;
    parts.push_back({state.frameCoordinate(view.frame), ray->point.transpose() * ray->pose});
  }
  const Eigen::Matrix3d minus_inverse = -A.inverse();
  for (Part& part : parts) part.G = (minus_inverse * part.G).eval();
  const Clone& pose = state.frames()[anchor];
  const Eigen::Vector3d from_anchor = point_map - pose.position_map;
  Part beside{state.frameCoordinate(anchor), {}};
  beside.G << -Eigen::Matrix3d::Identity(), skew(from_anchor);
  parts.push_back(beside);
  Part stretch{WindowState::kBias, Eigen::Matrix<double, 3, 6>::Zero()};  // not of what follows
  stretch.G.leftCols<3>() = from_anchor * pose.stretch_by_bias_s_m.transpose();
  stretch.G.col(WindowState::kScale - WindowState::kBias) = from_anchor;
  parts.push_back(stretch);

  const auto P = state.covariance();
  Eigen::Matrix3d half = Eigen::Matrix3d::Zero();  // of G P G', which is symmetric
  for (auto left = parts.begin(); left != parts.end(); ++left) {
    Eigen::Matrix<double, 6, 3> P_G =
        0.5 * P.block<6, 6>(left->coordinate, left->coordinate) * left->G.transpose();
    for (auto right = parts.begin(); right != left; ++right)
      P_G += P.block<6, 6>(left->coordinate, right->coordinate) * right->G.transpose();
    half += left->G * P_G;
  }
  return half + half.transpose();
}

double chiSquare95(int degrees_of_freedom) {
  const double k = degrees_of_freedom;
  const double spread = 2 / (9 * k);
  constexpr double kNormal95 = 1.6449;
  const double root = 1 - spread + kNormal95 * std::sqrt(spread);
  return k * root * root * root;
}

}  // namespace ardrone_vslam
