// SPDX-License-Identifier: BSD-3-Clause
#include "window/common_drift.hpp"

#include "linear/selection.hpp"
#include "linear/tiled_product.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kPose = WindowState::kFrame;

/// 0 to 2 if it is a pose's position, 3 to 5 of its attitude; else -1.
int poseCoordinate(const WindowState& state, int coordinate) {
  if (coordinate == WindowState::kFloor) return 2;  // a height is a position
  if (coordinate < WindowState::kGlobals) return -1;
  const int of_frames = coordinate - state.frameCoordinate(0);
  if (of_frames >= 0) return of_frames % kPose;
  const int of_anchor = (coordinate - WindowState::kGlobals) % WindowState::kAnchor;
  return of_anchor < kPose ? of_anchor : -1;
}

/// @param P  some rows of the covariance, all columns
template <class Rows>
Eigen::MatrixXf rowsTimes(const Rows& P, const WindowState& state, const std::vector<int>& of,
                          const Eigen::MatrixXd& B) {
  const auto common =
      P.template middleCols<kPose>(state.frameCoordinate(state.frames().size() - 1));
  const auto terms = static_cast<Eigen::Index>(of.size());
  Eigen::MatrixXf left(P.rows(), terms + kPose);
  Eigen::MatrixXf right(terms + kPose, B.cols());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(kPose, B.cols());
  for (Eigen::Index k = 0; k < terms; ++k) {
    const int coordinate = of[static_cast<std::size_t>(k)];
    const int of_pose = poseCoordinate(state, coordinate);
    if (of_pose < 0) {
      left.col(k) = P.col(coordinate).template cast<float>();
    } else {
      left.col(k) = (P.col(coordinate) - common.col(of_pose)).template cast<float>();
      sums.row(of_pose) += B.row(k);
    }
  }
  left.rightCols<kPose>() = common.template cast<float>();
  right << B.cast<float>(), sums.cast<float>();
  return tiledProduct(left, right);
}

}  // namespace

Eigen::MatrixXf covarianceTimes(const WindowState& state, const std::vector<int>& of,
                                const Eigen::MatrixXd& B) {
  return rowsTimes(state.covariance(), state, of, B);
}

Eigen::MatrixXf ownCovarianceTimes(const WindowState& state, const std::vector<int>& of,
                                   const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd rows = rowsOf(state.covariance(), of);
  return rowsTimes(rows, state, of, B);
}

}  // namespace ardrone_vslam
