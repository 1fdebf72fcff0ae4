// SPDX-License-Identifier: BSD-3-Clause
// Rows and columns of a covariance that come, go and change places.
#pragma once

#include <Eigen/Core>
#include <initializer_list>

namespace ardrone_vslam {

/// Coordinates first .. first + count - 1.
struct Range {
  int first;
  int count;
};

/// The coordinates of the ranges, in their order. By blocks: index by index takes five times as
/// long.
inline Eigen::MatrixXd picked(const Eigen::MatrixXd& P, std::initializer_list<Range> ranges) {
  int size = 0;
  for (const Range& range : ranges) size += range.count;
  Eigen::MatrixXd result(size, size);
  int row = 0;
  for (const Range& r : ranges) {
    int column = 0;
    for (const Range& c : ranges) {
      result.block(row, column, r.count, c.count) = P.block(r.first, c.first, r.count, c.count);
      column += c.count;
    }
    row += r.count;
  }
  return result;
}

inline Eigen::MatrixXd without(const Eigen::MatrixXd& P, int first, int count) {
  const int behind = first + count;
  return picked(P, {{0, first}, {behind, static_cast<int>(P.rows()) - behind}});
}

/// With `count` zero coordinates more before `at`.
inline Eigen::MatrixXd widened(const Eigen::MatrixXd& P, int at, int count) {
  const auto rest = P.rows() - at;
  Eigen::MatrixXd wider(P.rows() + count, P.cols() + count);
  wider.middleRows(at, count).setZero();
  wider.middleCols(at, count).setZero();
  wider.topLeftCorner(at, at) = P.topLeftCorner(at, at);
  wider.topRightCorner(at, rest) = P.topRightCorner(at, rest);
  wider.bottomLeftCorner(rest, at) = P.bottomLeftCorner(rest, at);
  wider.bottomRightCorner(rest, rest) = P.bottomRightCorner(rest, rest);
  return wider;
}

}  // namespace ardrone_vslam
