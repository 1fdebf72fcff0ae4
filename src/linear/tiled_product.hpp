// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

// Products of matrices of some hundred rows in single precision, by the vector kernels: the same
// numbers on every instruction set. The drone's processor takes fourteen cycles for a product of
// doubles and ten for a sum, and half a cycle each for those of floats. Eigen's product, compiled
// for the oldest processor of a kind, uses half of AVX2's vectors.
namespace ardrone_vslam {

/// a * b.
Eigen::MatrixXf tiledProduct(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b);

/// P -= a * b', where both are symmetric: half of the product is computed, and P stays symmetric
/// to the last bit.
void subtractSymmetricProduct(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b,
                              Eigen::Block<Eigen::MatrixXd> P);

}  // namespace ardrone_vslam
