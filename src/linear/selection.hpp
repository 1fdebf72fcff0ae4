// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ardrone_vslam {

/// Some rows of a matrix, in the order of `rows`. Eigen's own indexed views came with 3.4; Debian
/// 11 and Ubuntu 20.04 have 3.3.
template <class Derived>
auto rowsOf(const Eigen::MatrixBase<Derived>& matrix, const std::vector<int>& rows) {
  Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, Derived::ColsAtCompileTime> selected(
      static_cast<Eigen::Index>(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    selected.row(static_cast<Eigen::Index>(i)) = matrix.row(rows[i]);
  return selected;
}

/// @copydoc rowsOf()
template <class Derived>
auto colsOf(const Eigen::MatrixBase<Derived>& matrix, const std::vector<int>& cols) {
  Eigen::Matrix<typename Derived::Scalar, Derived::RowsAtCompileTime, Eigen::Dynamic> selected(
      matrix.rows(), static_cast<Eigen::Index>(cols.size()));
  for (std::size_t i = 0; i < cols.size(); ++i)
    selected.col(static_cast<Eigen::Index>(i)) = matrix.col(cols[i]);
  return selected;
}

}  // namespace ardrone_vslam
