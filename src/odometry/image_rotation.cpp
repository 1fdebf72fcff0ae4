// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/image_rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"
#include "odometry/common_rotation.hpp"

namespace ardrone_vslam {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;

constexpr int kPlaneRounds = 8;
constexpr double kInlierSigmas = 3;
constexpr double kInlierShare = 0.6;
/// Rays nearer to the way than this (sine) say little of their plane's direction.
constexpr double kNearestToDirection = 0.15;
/// Jumps of neighbouring corners are alike: more tracks than this say no more.
constexpr double kIndependentTracks = 40;
constexpr double kMostSense = 5;  // sigmas of one corner, of the way's sense

/// Weights are in squares of the corners' sigma.
struct Prior {
  Eigen::Vector3d direction_then = Eigen::Vector3d::UnitZ();
  double weight = 0;
  Eigen::Matrix3d R_then_now = Eigen::Matrix3d::Identity();
  double rotation_weight = 0;
};

Prior priorOf(const DisplacementGuess& guess, double corner_sigma_rad) {
  Prior prior;
  const double displacement_m = guess.displacement_m.norm();
  if (displacement_m > 0) prior.direction_then = guess.displacement_m / displacement_m;
  // Of the direction; a way much shorter than its sigma may point anywhere.
  const double sigma_rad =
      std::max(guess.sigma_m, 1e-3 * displacement_m) / std::max(displacement_m, 1e-9);
  prior.weight = squared(corner_sigma_rad / std::min(sigma_rad, 1.0));
  return prior;
}

/// Normal equations of the distances from the epipolar planes; turn, then the way across itself.
struct PlaneFit {
  Matrix5d A = Matrix5d::Zero();
  Vector5d g = Vector5d::Zero();
  double cost = 0;  // bounded: a pair costs at most 1
  int inliers = 0;
};

PlaneFit planeFit(const std::vector<BearingPair>& pairs, const ImageMotion& motion,
                  const Prior& prior, double scale_rad) {
  PlaneFit fit;
  const Eigen::Matrix<double, 3, 2> across = tangentsOf(motion.direction_then);
  for (const BearingPair& pair : pairs) {
    const Eigen::Vector3d now = motion.R_then_now * pair.now;
    const Eigen::Vector3d normal = motion.direction_then.cross(now);
    const double sine = std::max(normal.norm(), kNearestToDirection);
    const double left_rad = pair.then.dot(normal) / sine;
    Vector5d J;
    J << now.cross(pair.then.cross(motion.direction_then)),
        across.transpose() * now.cross(pair.then);
    J /= sine;
    const double off = left_rad / scale_rad;
    const double weight = weightOf(left_rad, scale_rad);
    fit.A += weight * J * J.transpose();
    fit.g += weight * left_rad * J;
    fit.cost += off * off / (1 + off * off);
    if (std::abs(off) < 1) ++fit.inliers;
  }
  const Eigen::Vector3d off = motion.direction_then - prior.direction_then;
  fit.A.bottomRightCorner<2, 2>() += prior.weight * Eigen::Matrix2d::Identity();
  fit.g.tail<2>() += prior.weight * across.transpose() * off;
  const Eigen::Vector3d rotated =
      prior.rotation_weight > 0 ? rotationVectorOf(motion.R_then_now * prior.R_then_now.transpose())
                                : Eigen::Vector3d::Zero();
  fit.A.topLeftCorner<3, 3>() += prior.rotation_weight * Eigen::Matrix3d::Identity();
  fit.g.head<3>() += prior.rotation_weight * rotated;
  fit.cost += (prior.weight * off.squaredNorm() + prior.rotation_weight * rotated.squaredNorm()) /
              (scale_rad * scale_rad);
  return fit;
}

/// Improves the motion (Levenberg and Marquardt); the scale shrinks to the corners' own noise.
PlaneFit refine(const std::vector<BearingPair>& pairs, double corner_sigma_rad, const Prior& prior,
                ImageMotion& motion) {
  double scale_rad = 4 * kInlierSigmas * corner_sigma_rad;
  double damping = 1e-3;
  PlaneFit fit = planeFit(pairs, motion, prior, scale_rad);
  for (int round = 0; round < kPlaneRounds; ++round) {
    Matrix5d A = fit.A;
    A.diagonal() *= 1 + damping;
    const Vector5d step = -A.ldlt().solve(fit.g);
    ImageMotion moved;
    moved.direction_then =
        (motion.direction_then + tangentsOf(motion.direction_then) * step.tail<2>()).normalized();
    moved.R_then_now = rotationOf(step.head<3>()) * motion.R_then_now;
    const PlaneFit tried = planeFit(pairs, moved, prior, scale_rad);
    const bool is_better = tried.cost < fit.cost;
    if (is_better) {
      motion = moved;
      fit = tried;
    }
    damping *= is_better ? 0.1 : 10;
    if (round == kPlaneRounds / 2) {
      scale_rad = kInlierSigmas * corner_sigma_rad;
      fit = planeFit(pairs, motion, prior, scale_rad);
    }
  }
  return fit;
}

/// Points are in front of the camera: the way's sign, and pairs that contradict it cost like
/// outliers.
void findSense(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
               ImageMotion& motion) {
  double ahead = 0;
  int forward = 0, backward = 0;
  for (const BearingPair& pair : pairs) {
    const Eigen::Vector3d now = motion.R_then_now * pair.now;
    const Eigen::Vector3d across =
        pair.then.dot(motion.direction_then) * pair.then - motion.direction_then;
    const double sine = across.norm();
    if (sine < kNearestToDirection) continue;
    const double shift = (now - pair.then).dot(across) / sine / corner_sigma_rad;
    const Eigen::Vector3d normal = motion.direction_then.cross(now);
    if (std::abs(pair.then.dot(normal)) > kInlierSigmas * corner_sigma_rad * sine) continue;
    ahead += std::clamp(shift, -kMostSense, kMostSense);
    forward += shift > kInlierSigmas ? 1 : 0;
    backward += shift < -kInlierSigmas ? 1 : 0;
  }
  if (ahead < 0) {
    motion.direction_then = -motion.direction_then;
    std::swap(forward, backward);
  }
  motion.cost += backward;
}

}  // namespace

Eigen::Matrix<double, 3, 2> tangentsOf(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = direction.unitOrthogonal();
  across.col(1) = direction.cross(across.col(0));
  return across;
}

std::optional<ImageMotion> fitMotion(const std::vector<BearingPair>& pairs, double corner_sigma_rad,
                                     const DisplacementGuess& guess) {
  if (pairs.size() < kFewestRotationTracks) return std::nullopt;
  const Prior prior = priorOf(guess, corner_sigma_rad);
  ImageMotion motion;
  motion.direction_then = prior.direction_then;
  motion.R_then_now = commonRotation(pairs, kInlierSigmas * corner_sigma_rad, prior.direction_then);
  const PlaneFit fit = refine(pairs, corner_sigma_rad, prior, motion);
  const auto count = static_cast<double>(pairs.size());
  if (!motion.R_then_now.allFinite() || fit.inliers < kInlierShare * count) return std::nullopt;
  const double share = std::min(1.0, kIndependentTracks / fit.inliers);
  Matrix5d of_prior = Matrix5d::Zero();
  of_prior.bottomRightCorner<2, 2>() = prior.weight * Eigen::Matrix2d::Identity();
  motion.information =
      (share * (fit.A - of_prior) + of_prior) / (corner_sigma_rad * corner_sigma_rad);
  motion.inliers = fit.inliers;
  motion.cost = fit.cost;
  findSense(pairs, corner_sigma_rad, motion);
  return motion;
}

double squaresAgainst(const KnownMotion& known, const ImageMotion& fitted,
                      const std::vector<BearingPair>& pairs, double corner_sigma_rad) {
  Prior prior = priorOf(known.displacement, corner_sigma_rad);
  prior.R_then_now = known.R_then_now;
  prior.rotation_weight = squared(corner_sigma_rad / known.rotation_sigma_rad);
  ImageMotion motion;
  motion.direction_then = prior.direction_then;
  motion.R_then_now = known.R_then_now;
  motion.cost = refine(pairs, corner_sigma_rad, prior, motion).cost;
  findSense(pairs, corner_sigma_rad, motion);
  const double share = std::min(1.0, kIndependentTracks / std::max(fitted.inliers, 1));
  // At the scale a pair costs one half.
  constexpr double kSquaresOfCost = 2 * kInlierSigmas * kInlierSigmas;
  return kSquaresOfCost * share * std::max(0.0, motion.cost - fitted.cost);
}

std::optional<ImageRotation> fitRotation(const std::vector<BearingPair>& pairs,
                                         double corner_sigma_rad, const DisplacementGuess& guess) {
  const auto motion = fitMotion(pairs, corner_sigma_rad, guess);
  if (!motion) return std::nullopt;
  const Eigen::Matrix<double, 3, 2> A_mixed = motion->information.topRightCorner<3, 2>();
  ImageRotation rotation;
  rotation.R_then_now = motion->R_then_now;
  rotation.information =
      motion->information.topLeftCorner<3, 3>() -
      A_mixed * motion->information.bottomRightCorner<2, 2>().inverse() * A_mixed.transpose();
  rotation.inliers = motion->inliers;
  return rotation;
}

}  // namespace ardrone_vslam
