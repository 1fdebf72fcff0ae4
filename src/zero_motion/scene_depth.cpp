// SPDX-License-Identifier: BSD-3-Clause
#include "zero_motion/scene_depth.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// Depths, and what is believed of them before anything is seen: a room, or ten times that.
constexpr std::size_t kDepths = 28;
constexpr double kNearest_m = 0.5;
constexpr double kDepthRatio = 1.32;
constexpr double kPriorDepth_m = 5;
constexpr double kPriorSigma = 1.3;  // of the logarithm
// Another part of the scene comes into view: random walk of the logarithm.
constexpr double kWalk_per_sqrt_s = 0.1;
constexpr double kWalk_per_sqrt_rad = 0.5;
constexpr double kLeastProbability = 1e-12;

// When images are compared.
constexpr double kBetweenLooks_s = 0.35;
constexpr double kLongest_s = 4;       // the bias changes meanwhile
constexpr double kTellsEnough = 0.05;  // way over depth
constexpr double kRotationSigma_rad = 0.003;

// The odometry: twice as bad as a drone's usually is.
constexpr double kBias_m_s = 0.06;
constexpr double kBiasTime_s = 20;
constexpr double kWalk_m_per_sqrt_s = 0.06;
constexpr double kScaleSigma = 0.05;
// The camera's true speed per axis may be of any of these magnitudes.
constexpr std::array<double, 7> kSpeeds_m_s{0.01, 0.03, 0.1, 0.3, 1, 3, 10};
// What no depth explains tells none of them.
constexpr double kMostOff = 25;
constexpr double kMostSeen = 100;

double passedSince(const ImageRays& then, const ImageRays& now) {
  return seconds(now.stamp_ns - then.stamp_ns);
}

}  // namespace

SceneDepth::SceneDepth() : hypotheses_(kDepths) {
  double depth_m = kNearest_m;
  for (Hypothesis& one : hypotheses_) {
    one.depth_m = depth_m;
    one.probability =
        portable::exp(-0.5 * squared(portable::log(depth_m / kPriorDepth_m) / kPriorSigma));
    one.covariance.diagonal().setConstant(squared(kBias_m_s));
    depth_m *= kDepthRatio;
  }
}

void SceneDepth::see(const ImageFeatures& features, const Eigen::Isometry3d& T_odom_cam) {
  const bool is_first = reference_.rays.rays.empty();
  if (!is_first && seconds(features.stamp_ns - now_.rays.stamp_ns) < kBetweenLooks_s) return;
  now_.rays.take(features, order_);
  now_.T_odom_cam = T_odom_cam;
  findPairs(reference_.rays, now_.rays, pairs_);

  Motion motion;
  motion.passed_s = passedSince(reference_.rays, now_.rays);
  motion.odometry_m = T_odom_cam.translation() - reference_.T_odom_cam.translation();
  const Eigen::Matrix3d R_odom_then = reference_.T_odom_cam.linear();
  const Eigen::Matrix3d R_then_now = R_odom_then.transpose() * T_odom_cam.linear();
  std::optional<SeenMotion> seen;
  if (pairs_.size() >= kFewestPairs)
    seen = seenMotion(pairs_, R_then_now, kRotationSigma_rad,
                      kCornerSigma_px / features.focal_length_px);
  const bool is_fading = 2 * pairs_.size() < std::min(kMostPairs, reference_.rays.rays.size());
  const bool is_long = is_fading || motion.passed_s > kLongest_s ||
                       (seen && seen->displacement.norm() > kTellsEnough);
  if (seen && !is_long) return;  // the longer, the more it tells
  if (seen) {
    motion.seen.displacement = R_odom_then * seen->displacement;
    motion.seen.covariance = R_odom_then * seen->covariance * R_odom_then.transpose();
    judge(motion);
    spread(motion.passed_s, angleOf_rad(R_then_now));
  }
  reference_ = now_;
}

double SceneDepth::quantile_m(double probability) const {
  double all = 0;
  for (const Hypothesis& one : hypotheses_) all += one.probability;
  double nearer = 0;
  for (const Hypothesis& one : hypotheses_) {
    nearer += one.probability;
    if (nearer >= probability * all) return one.depth_m;
  }
  return hypotheses_.back().depth_m;
}

void SceneDepth::judge(const Motion& motion) {
  double most = 0;
  for (Hypothesis& one : hypotheses_) {
    one.probability *= explain(motion, one);
    most = std::max(most, one.probability);
  }
  if (!(most > 0)) return;
  for (Hypothesis& one : hypotheses_)
    one.probability = std::max(one.probability / most, kLeastProbability);
}

/// Corrects the bias. @return how probable the motion is at this depth
double SceneDepth::explain(const Motion& motion, Hypothesis& hypothesis) {
  const double passed_s = motion.passed_s;
  const double keep = portable::exp(-passed_s / kBiasTime_s);
  Eigen::Vector3d bias = keep * hypothesis.bias_m_s;
  Eigen::Matrix3d B = squared(keep) * hypothesis.covariance;
  B.diagonal().array() += squared(kBias_m_s) * (1 - squared(keep));
  Eigen::Matrix3d of_odometry = squared(passed_s) * B;
  of_odometry.diagonal().array() += squared(kWalk_m_per_sqrt_s) * passed_s +
                                    squared(kScaleSigma) * motion.odometry_m.squaredNorm();

  const Eigen::Matrix3d& R = motion.seen.covariance;
  double sum = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const double speed_m_s : kSpeeds_m_s) {
    // The true way given what is seen: its mean and, with the odometry's errors, its covariance.
    const double displacement_m = speed_m_s * passed_s;
    Eigen::Matrix3d S_seen = R;
    S_seen.diagonal().array() += squared(displacement_m / hypothesis.depth_m);
    const Eigen::Matrix3d S_seen_inverse = S_seen.inverse();
    const Eigen::Matrix3d displacement_of_seen =
        squared(displacement_m) / hypothesis.depth_m * S_seen_inverse;
    const Eigen::Matrix3d S = of_odometry + hypothesis.depth_m * displacement_of_seen * R;
    const Eigen::Matrix3d S_inverse = S.inverse();
    const Eigen::Vector3d off =
        motion.odometry_m - displacement_of_seen * motion.seen.displacement - passed_s * bias;
    const double off_squares = off.dot(S_inverse * off);
    const double seen_squares =
        motion.seen.displacement.dot(S_seen_inverse * motion.seen.displacement);
    const double squares = std::min(off_squares, kMostOff) + std::min(seen_squares, kMostSeen);
    const double density =
        portable::exp(-0.5 * squares) / std::sqrt(S.determinant() * S_seen.determinant());
    const Eigen::Matrix3d gain = passed_s * B * S_inverse;
    // No further than by what it costs: else a bias that nothing explains would explain all.
    const double share = std::sqrt(kMostOff / std::max(off_squares, kMostOff));
    const Eigen::Vector3d corrected = bias + share * gain * off;
    sum += density;
    mean += density * corrected;
    square += density * (B - passed_s * gain * B + corrected * corrected.transpose());
  }
  if (!(sum > 0)) return 0;
  mean /= sum;
  hypothesis.bias_m_s = mean;
  hypothesis.covariance = square / sum - mean * mean.transpose();
  return sum;
}

void SceneDepth::spread(double passed_s, double rotation_rad) {
  const double variance =
      squared(kWalk_per_sqrt_s) * passed_s + squared(kWalk_per_sqrt_rad) * rotation_rad;
  const double to_each_side = std::min(0.25, variance / (2 * squared(portable::log(kDepthRatio))));
  double moved_on = 0;  // from the next nearer depth
  for (std::size_t i = 0; i < kDepths; ++i) {
    const double moving = to_each_side * hypotheses_[i].probability;
    const bool is_last = i + 1 == kDepths;
    const double back = is_last ? 0 : to_each_side * hypotheses_[i + 1].probability;
    hypotheses_[i].probability += moved_on + back - (i == 0 ? 0 : moving) - (is_last ? 0 : moving);
    moved_on = moving;
  }
}

}  // namespace ardrone_vslam
