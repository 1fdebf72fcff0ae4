// SPDX-License-Identifier: BSD-3-Clause
#include "window/correction.hpp"

#include <Eigen/Cholesky>

#include "linear/information_root.hpp"
#include "linear/selection.hpp"
#include "linear/tiled_product.hpp"
#include "window/common_drift.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {
namespace {

// What single precision rounds off of a correction, per variance that it takes: products of a
// hundred terms, and eigenvalues of a matrix of such errors.
constexpr double kRounding = 2e-6;
// Of a variance [m^2, rad^2]: what is taken of the drift in flight is less, of a step of the
// odometry or after a long blind stretch more. The rounding is then below (0.2 mm)^2.
constexpr double kMostInSingle = 0.02;

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

Eigen::MatrixXf product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  return tiledProduct(a, b);
}
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a * b;
}

// Makes the gain of P B. @return the error; nothing when it is not positive
template <class Scalar>
std::optional<Eigen::VectorXd> finish(const InformationRoot& root, const std::vector<int>& measured,
                                      Matrix<Scalar>& G) {
  const Matrix<Scalar> of_measured = rowsOf(G, measured);
  Matrix<Scalar> M = product(root.rows.cast<Scalar>().transpose(), of_measured);
  M.diagonal().array() += 1;
  const Eigen::LLT<Eigen::Ref<Matrix<Scalar>>> inner(M);
  if (inner.info() != Eigen::Success) return std::nullopt;
  inner.matrixU().template solveInPlace<Eigen::OnTheRight>(G);
  const Matrix<Scalar> values = root.measured.cast<Scalar>();
  return (G * inner.matrixL().solve(values)).template cast<double>();
}

}  // namespace

std::optional<Correction> Correction::by(const Information& information, const WindowState& state) {
  const std::vector<int>& w = information.coordinates;
  const auto P = state.covariance();
  const InformationRoot root(information, rowsOf(P.diagonal(), w));
  Correction result;
  if (root.measured.size() == 0) return result;
  result.single_ = covarianceTimes(state, w, root.rows);
  auto error = finish(root, w, result.single_);
  if (!error || !(result.single_.rowwise().squaredNorm().maxCoeff() < kMostInSingle)) {
    result.doubles_ = colsOf(P, w) * root.rows;
    error = finish(root, w, result.doubles_);
  }
  if (!error || !error->allFinite()) return std::nullopt;
  result.error_ = *error;
  return result;
}

Eigen::MatrixX4d Correction::gainTimesRows(int first) const {
  if (doubles_.size() > 0) return doubles_ * doubles_.middleRows<4>(first).transpose();
  return (single_ * single_.middleRows<4>(first).transpose()).cast<double>();
}

void Correction::subtractFrom(Eigen::Block<Eigen::MatrixXd> P, const Eigen::MatrixX4d& T,
                              const Eigen::MatrixX4d& V) const {
  if (doubles_.size() > 0) {
    P.triangularView<Eigen::Lower>() -=
        doubles_ * doubles_.transpose() + T * V.transpose() + V * T.transpose();
    P.triangularView<Eigen::StrictlyUpper>() = P.transpose();
    return;
  }
  Eigen::MatrixXf left(single_.rows(), single_.cols() + 8);
  Eigen::MatrixXf right(single_.rows(), single_.cols() + 8);
  left << single_, T.cast<float>(), V.cast<float>();
  right << single_, V.cast<float>(), T.cast<float>();
  subtractSymmetricProduct(left, right, P);
  P.diagonal() += kRounding * single_.rowwise().squaredNorm().cast<double>();
}

}  // namespace ardrone_vslam
