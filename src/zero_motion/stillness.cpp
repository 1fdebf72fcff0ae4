// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/stillness.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "ardrone_vslam/rotation.hpp"
#include "linear/median.hpp"

namespace ardrone_vslam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kInlierShare = 0.6;  // a third of the tracks may be wrong
constexpr double kShiftGate = 16;     // chi-square with three degrees of freedom: 99.9 %

void leftOf(const std::vector<BearingPair>& pairs, const Eigen::Matrix3d& R,
            std::vector<double>& left_rad) {
  left_rad.resize(pairs.size());
  std::transform(pairs.begin(), pairs.end(), left_rad.begin(),
                 [&R](const BearingPair& pair) { return (R * pair.now - pair.then).norm(); });
}

// The turn that most tracks agree on: weights fall with what is left (Geman and McClure), and what
// counts as much left shrinks to the corners' own noise.
Eigen::Matrix3d agreedRotation(const std::vector<BearingPair>& pairs, Eigen::Matrix3d R,
                               double jump_rad) {
  constexpr int kRounds = 8;
  std::vector<double> left;
  std::vector<double> sorted;
  for (int round = 0; round < kRounds; ++round) {
    leftOf(pairs, R, left);
    sorted = left;
    const double scale = std::max(2 * medianOf(sorted), kInlierSigmas * jump_rad);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double off = left[i] / scale;
      const double weight = 1 / ((1 + off * off) * (1 + off * off));
      const Eigen::Vector3d now = R * pairs[i].now;
      A += weight * (Eigen::Matrix3d::Identity() - now * now.transpose());
      g += weight * now.cross(now - pairs[i].then);
    }
    R = rotationOf(-A.ldlt().solve(g)) * R;
  }
  return R;
}

/// What the pairs that one turn explains say of another small turn and of a shift over depth.
struct RotationAndShift {
  Matrix6d A = Matrix6d::Zero();  // turn, shift
  Vector6d g = Vector6d::Zero();
  int inliers = 0;

  RotationAndShift(const std::vector<BearingPair>& pairs, const Eigen::Matrix3d& R,
                   double jump_rad) {
    for (const BearingPair& pair : pairs) {
      const Eigen::Vector3d now = R * pair.now;
      const Eigen::Vector3d left = now - pair.then;
      if (left.norm() > kInlierSigmas * jump_rad) continue;
      ++inliers;
      Eigen::Matrix<double, 3, 6> J;
      J << -skew(now), now * now.transpose() - Eigen::Matrix3d::Identity();
      A += J.transpose() * J;
      g += J.transpose() * left;
    }
    const double share = std::min(1.0, kIndependentTracks / inliers);
    A *= share / (jump_rad * jump_rad);
    g *= share / (jump_rad * jump_rad);
  }

  Eigen::Matrix3d rotation() const { return A.topLeftCorner<3, 3>(); }
  Eigen::Matrix3d mixed() const { return A.topRightCorner<3, 3>(); }

  /// Information of the shift, the turn being known as well as this.
  Eigen::Matrix3d shiftGiven(const Eigen::Matrix3d& rotation) const {
    return A.bottomRightCorner<3, 3>() - mixed().transpose() * rotation.ldlt().solve(mixed());
  }

  /// Squared Mahalanobis length of the shift, the turn being free to make up for it.
  double squaredShift() const {
    // Keeps the shifts that a turn makes up for wholly from counting as seen.
    const Eigen::Matrix3d seen = shiftGiven(rotation()) + Eigen::Matrix3d::Identity();
    const Eigen::Vector3d g_shift =
        g.tail<3>() - mixed().transpose() * rotation().ldlt().solve(g.head<3>());
    return g_shift.dot(seen.ldlt().solve(g_shift));
  }
};

}  // namespace

double medianLeft_rad(const std::vector<BearingPair>& pairs,
                      const Eigen::Matrix3d& R_reference_now) {
  if (pairs.empty()) return 0;
  std::vector<double> left;
  leftOf(pairs, R_reference_now, left);
  return medianOf(left);
}

Stillness stillnessOf(const std::vector<BearingPair>& pairs, const OdometryRotation& odometry,
                      const Eigen::Matrix3d& R_guess, double focal_length_px) {
  Stillness s;
  s.common = static_cast<int>(pairs.size());
  s.enough_tracks = pairs.size() >= kFewestPairs;
  if (!s.enough_tracks) return s;
  const double jump_rad = kCornerJump_px / focal_length_px;
  const Eigen::Matrix3d R = agreedRotation(pairs, R_guess, jump_rad);
  if (!R.allFinite()) return s;
  s.R_reference_now = R;

  const RotationAndShift rest(pairs, R, jump_rad);
  s.inlier_share = static_cast<double>(rest.inliers) / static_cast<double>(pairs.size());
  s.median_px = medianLeft_rad(pairs, R) * focal_length_px;
  if (s.inlier_share < kInlierShare) return s;
  const double off_rad = angleOf_rad(R * odometry.R_reference_now.transpose());
  s.is_still = rest.squaredShift() < kShiftGate && off_rad < kRotationSigmas * odometry.sigma_rad;

  // A turn may stand for a shift by as much as it turned, or as little as the attitude is known.
  const double rotation_rad = std::min(angleOf_rad(R), odometry.sigma_rad) + 1e-6;
  s.hidden =
      rest.shiftGiven(rest.rotation() + Eigen::Matrix3d::Identity() / (rotation_rad * rotation_rad))
          .inverse();
  return s;
}

}  // namespace ardrone_vslam
