// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bundle_covariance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <stdexcept>
#include <unordered_set>

namespace ardrone_vslam {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr Eigen::Index kPoint = 3;  // parameters

/// Of the residuals, columns in the blocks' order.
Sparse jacobianOf(ceres::Problem& problem, const std::vector<double*>& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks;
  ceres::CRSMatrix crs;
  problem.Evaluate(options, nullptr, nullptr, nullptr, &crs);
  return Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
      crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
      crs.cols.data(), crs.values.data());
}

/// R R^T is the inverse of a matrix whose blocks of points lie on its diagonal.
Sparse inverseRoot(const Sparse& blocks) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(kPoint * blocks.cols()));
  for (Eigen::Index at = 0; at < blocks.cols(); at += kPoint) {
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    for (Eigen::Index column = 0; column < kPoint; ++column) {
      for (Sparse::InnerIterator entry(blocks, at + column); entry; ++entry)
        block(entry.row() - at, column) = entry.value();
    }
    const Eigen::LLT<Eigen::Matrix3d> factor(block);
    if (factor.info() != Eigen::Success)
      throw std::runtime_error("nothing tells how well a point is known");
    const Eigen::Matrix3d root =
        factor.matrixU().solve(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
    for (Eigen::Index i = 0; i < kPoint; ++i) {
      for (Eigen::Index j = i; j < kPoint; ++j)
        entries.emplace_back(static_cast<int>(at + i), static_cast<int>(at + j), root(i, j));
    }
  }
  Sparse root(blocks.rows(), blocks.cols());
  root.setFromTriplets(entries.begin(), entries.end());
  return root;
}

}  // namespace

Eigen::MatrixXd covarianceOf(ceres::Problem& problem, const std::vector<double*>& wanted,
                             const std::vector<double*>& points) {
  std::unordered_set<const double*> known(wanted.begin(), wanted.end());
  known.insert(points.begin(), points.end());
  std::vector<double*> all, order = wanted;
  problem.GetParameterBlocks(&all);
  for (double* block : all) {
    if (known.count(block) == 0) order.push_back(block);
  }
  order.insert(order.end(), points.begin(), points.end());
  const Sparse J = jacobianOf(problem, order);
  const Eigen::Index of_points = kPoint * static_cast<Eigen::Index>(points.size());
  const Sparse by_points = J.rightCols(of_points);
  const Sparse by_others = J.leftCols(J.cols() - of_points);
  const Sparse root = inverseRoot(Sparse(by_points.transpose() * by_points));
  const Sparse shared = Sparse(by_others.transpose() * by_points) * root;
  const Sparse reduced =
      Sparse(by_others.transpose() * by_others) - Sparse(shared * shared.transpose());

  Eigen::Index size = 0;
  for (const double* block : wanted) size += problem.ParameterBlockSize(block);
  const Eigen::SimplicialLLT<Sparse> factor(reduced);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("nothing tells how well the flight is known");
  const Eigen::MatrixXd columns = factor.solve(Eigen::MatrixXd::Identity(reduced.rows(), size));
  const Eigen::MatrixXd P = columns.topRows(size);
  if (!P.allFinite()) throw std::runtime_error("what is known of the flight is out of range");
  return 0.5 * (P + P.transpose());
}

}  // namespace ardrone_vslam
