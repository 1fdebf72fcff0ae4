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

/// The normal equations with the points eliminated, of all columns before theirs.
Sparse withoutPoints(const Sparse& J, Eigen::Index of_points) {
  const Sparse by_points = J.rightCols(of_points);
  const Sparse by_others = J.leftCols(J.cols() - of_points);
  const Sparse root = inverseRoot(Sparse(by_points.transpose() * by_points));
  const Sparse shared = Sparse(by_others.transpose() * by_points) * root;
  return Sparse(by_others.transpose() * by_others) - Sparse(shared * shared.transpose());
}

/// The same with the chain eliminated, whose rows are the last.
Eigen::MatrixXd withoutChain(const Sparse& equations, Eigen::Index of_chain) {
  const Eigen::Index kept = equations.rows() - of_chain;
  const Sparse chain = equations.bottomRightCorner(of_chain, of_chain);
  const Eigen::SimplicialLLT<Sparse> factor(chain);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("nothing tells how the odometry errs");
  const Sparse across = equations.bottomLeftCorner(of_chain, kept);
  const Eigen::MatrixXd solved = factor.solve(Eigen::MatrixXd(across));
  Eigen::MatrixXd reduced = equations.topLeftCorner(kept, kept);
  reduced -= across.transpose() * solved;
  return reduced;
}

Eigen::Index sizeOf(const ceres::Problem& problem, const std::vector<double*>& blocks) {
  Eigen::Index size = 0;
  for (const double* block : blocks) size += problem.ParameterBlockSize(block);
  return size;
}

}  // namespace

Eigen::MatrixXd covarianceOf(ceres::Problem& problem, const std::vector<double*>& wanted,
                             const std::vector<double*>& chain,
                             const std::vector<double*>& points) {
  std::unordered_set<const double*> known;
  for (const auto* blocks : {&wanted, &chain, &points})
    known.insert(blocks->begin(), blocks->end());
  std::vector<double*> all, order = wanted;
  problem.GetParameterBlocks(&all);
  for (double* block : all) {
    if (known.count(block) == 0) order.push_back(block);
  }
  order.insert(order.end(), chain.begin(), chain.end());
  order.insert(order.end(), points.begin(), points.end());
  const Sparse equations = withoutPoints(jacobianOf(problem, order), sizeOf(problem, points));
  Eigen::MatrixXd reduced = withoutChain(equations, sizeOf(problem, chain));

  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(reduced);  // in place
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("nothing tells how well the flight is known");
  const Eigen::Index size = sizeOf(problem, wanted);
  const Eigen::MatrixXd columns = factor.solve(Eigen::MatrixXd::Identity(reduced.rows(), size));
  const Eigen::MatrixXd P = columns.topRows(size);
  if (!P.allFinite()) throw std::runtime_error("what is known of the flight is out of range");
  return 0.5 * (P + P.transpose());
}

}  // namespace ardrone_vslam
