// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/seen_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kFitRounds = 4;
constexpr double kFewestAgree = 0.4;   // share of the pairs
constexpr double kDepthSpread = 0.5;   // of points, over the typical depth
constexpr double kTypicalError = 0.2;  // of the typical depth, as few points tell it
constexpr double kWeakest = 1e-3;      // keeps what no pair shows solvable

struct DisplacementFit {
  Matrix6d A = Matrix6d::Zero();  // way, turn
  Vector6d g = Vector6d::Zero();
  int inliers = 0;
  int pairs = 0;
};

// Weights of Geman and McClure: they fall with what the last round's solution leaves.
DisplacementFit fitAround(const std::vector<BearingPair>& pairs, const Eigen::Matrix3d& R_then_now,
                          double corner_sigma_rad, const Vector6d& last, bool is_first) {
  DisplacementFit fit;
  const std::size_t every = 1 + (pairs.size() - 1) / kMostPairs;
  for (std::size_t i = 0; i < pairs.size(); i += every) {
    const Eigen::Vector3d& then = pairs[i].then;
    const Eigen::Vector3d shift = R_then_now * pairs[i].now - then;
    Eigen::Matrix<double, 3, 6> J;
    J << then * then.transpose() - Eigen::Matrix3d::Identity(), -skew(then);
    const double by_displacement = (J.leftCols<3>() * last.head<3>()).norm();
    const double scale =
        kInlierSigmas * portable::hypot(corner_sigma_rad, kDepthSpread * by_displacement);
    const double off = (J * last - shift).squaredNorm() / squared(scale);
    const double weight = is_first ? 1 : 1 / squared(1 + off);
    fit.A += weight * J.transpose() * J;
    fit.g += weight * J.transpose() * shift;
    fit.inliers += off < 1 ? 1 : 0;
    ++fit.pairs;
  }
  return fit;
}

}  // namespace

std::optional<SeenMotion> seenMotion(const std::vector<BearingPair>& pairs,
                                     const Eigen::Matrix3d& R_then_now, double rotation_sigma_rad,
                                     double corner_sigma_rad) {
  if (pairs.empty()) return std::nullopt;
  Vector6d solution = Vector6d::Zero();
  DisplacementFit fit;
  for (int round = 0; round < kFitRounds; ++round) {
    fit = fitAround(pairs, R_then_now, corner_sigma_rad, solution, round == 0);
    const double weight =
        std::min(1.0, kIndependentTracks / std::max(fit.inliers, 1)) / squared(corner_sigma_rad);
    fit.A *= weight;
    fit.A.diagonal().array() += kWeakest;
    fit.A.diagonal().tail<3>().array() += 1 / squared(rotation_sigma_rad);
    solution = fit.A.ldlt().solve(weight * fit.g);
  }
  if (!solution.allFinite() || fit.inliers < kFewestAgree * fit.pairs) return std::nullopt;
  SeenMotion seen;
  seen.displacement = solution.head<3>();
  seen.covariance = fit.A.inverse().topLeftCorner<3, 3>();
  seen.covariance.diagonal().array() += squared(kTypicalError) * seen.displacement.squaredNorm();
  return seen;
}

}  // namespace ardrone_vslam
