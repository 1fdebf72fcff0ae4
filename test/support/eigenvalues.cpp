// SPDX-License-Identifier: BSD-3-Clause
#include "support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace ardrone_vslam::test {

Eigen::VectorXd eigenvaluesOf(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace ardrone_vslam::test
