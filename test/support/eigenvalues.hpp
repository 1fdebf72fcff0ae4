// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace ardrone_vslam::test {

/// Of a symmetric matrix, ascending. Compiled once: the solver's templates take longest of all.
Eigen::VectorXd eigenvaluesOf(const Eigen::MatrixXd& symmetric);

inline double leastEigenvalue(const Eigen::MatrixXd& symmetric) {
  return eigenvaluesOf(symmetric)[0];
}

}  // namespace ardrone_vslam::test
