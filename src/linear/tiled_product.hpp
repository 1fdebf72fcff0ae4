// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

// Products of matrices of some hundred rows by the vector kernels: the same numbers on every
// instruction set. Eigen, compiled for the oldest processor, takes twice as long as AVX-512.
namespace ardrone_vslam {

/// a * b.
Eigen::MatrixXd tiledProduct(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// P -= a * b', where both are symmetric: half of the product is computed, and P stays symmetric
/// to the last bit.
void subtractSymmetricProduct(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                              Eigen::Block<Eigen::MatrixXd> P);

}  // namespace ardrone_vslam
