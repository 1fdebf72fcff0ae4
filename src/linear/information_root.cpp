// SPDX-License-Identifier: BSD-3-Clause
#include "linear/information_root.hpp"

#include <cmath>

#include "linear/information.hpp"

namespace ardrone_vslam {

InformationRoot::InformationRoot(const Information& information, const Eigen::VectorXd& variances) {
  // Of a pivot so much is left by rounding alone.
  constexpr double kRounding = 1e-13;
  const Eigen::MatrixXd& N = information.matrix;
  const Eigen::Index size = N.rows();
  const Eigen::VectorXd whole = (variances.array() > 0).select(N.diagonal(), 0.0);
  const Eigen::VectorXd per_whole = (whole.array() > 0).select(whole.cwiseInverse(), 0.0);
  Eigen::VectorXd left = whole;
  rows.resize(size, size);
  measured.resize(size);
  Eigen::VectorXd before(size);
  Eigen::VectorXd explained(size);  // of the pivot's column, by the rows so far
  Eigen::Index rank = 0;
  for (; rank < size; ++rank) {
    Eigen::Index pivot = 0;
    const double share = left.cwiseProduct(per_whole).maxCoeff(&pivot);
    if (!(share > kRounding)) break;
    before.head(rank) = rows.row(pivot).head(rank).transpose();
    explained.noalias() = rows.leftCols(rank) * before.head(rank);
    const double root = std::sqrt(left(pivot));
    rows.col(rank) = (N.col(pivot) - explained) / root;
    measured(rank) =
        (information.vector(pivot) - before.head(rank).dot(measured.head(rank))) / root;
    left -= rows.col(rank).cwiseAbs2();
    left(pivot) = 0;
  }
  rows.conservativeResize(Eigen::NoChange, rank);
  measured.conservativeResize(rank);
}

}  // namespace ardrone_vslam
