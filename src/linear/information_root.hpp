// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace ardrone_vslam {

struct Information;

/// Information as that of the fewest measurements with unit noise: H' W H = rows rows' and
/// H' W r = rows measured. Most informations are far from regular: tracks say nothing of scale and
/// place of the window, and few of them little of most of its frames. Eigen's LDLT does not stop at
/// the rank, and its pivots know nothing of exact coordinates.
struct InformationRoot {
  Eigen::MatrixXd rows;  ///< transposed: a column a measurement
  Eigen::VectorXd measured;

  /// Cholesky decomposition up to the rank, the largest remaining share of a pivot first. Exact
  /// coordinates are no pivots: what is measured of them alone corrects nothing.
  /// O(size * rank^2).
  /// @param variances  of the coordinates; zero: exact
  InformationRoot(const Information& information, const Eigen::VectorXd& variances);
};

}  // namespace ardrone_vslam
