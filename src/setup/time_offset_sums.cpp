// SPDX-License-Identifier: BSD-3-Clause
#include "setup/time_offset_sums.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRotationNoise_rad = 0.002;  // white noise of a turn by the odometry, per axis
constexpr double kCalibration = 0.02;         // of a turn, by focal length and lens
constexpr double kDrift_rad_s = 0.02;         // sigma of the rates' constant difference
constexpr double kDepth_m = 3;                // of the scene, roughly
constexpr double kScale = 0.1;                // sigma of the turns' constant relative difference
constexpr double kOutlierSigmas = 5;          // of a turn
constexpr double kFewestRotations = 30;       // in the sums
constexpr double kClearRotation = 16;         // mean square of turns, in sigmas: no noise
constexpr double kAlike = 4;                  // mean square that may stay; usual is below 1
constexpr double kSignificant = 5;            // times what noise makes of the squares
constexpr double kTwoRotations = 4;           // squares of a difference of two like turns, at most
constexpr std::size_t kParabola = 5;          // grid points to each side of the minimum
constexpr double kLikeNeighbours = 2;         // turns of neighbouring images share their errors
constexpr double kFloor_s = 0.001;            // smoothing and grid

struct Parabola {
  double slope = 0;  // in its middle, per grid step
  double curvature = 0;
};

/// Least squares through 2 kParabola + 1 points.
Parabola parabolaThrough(const double* points) {
  double count = 0, x2 = 0, x4 = 0, y = 0, xy = 0, x2y = 0;
  for (std::size_t i = 0; i <= 2 * kParabola; ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(kParabola);
    count += 1;
    x2 += x * x;
    x4 += x * x * x * x;
    y += points[i];
    xy += x * points[i];
    x2y += x * x * points[i];
  }
  return {xy / x2, 2 * (count * x2y - x2 * y) / (count * x4 - x2 * x2)};
}

Matrix6d priorOfConstants() {
  Vector6d information;
  information.head<3>().setConstant(1 / (kDrift_rad_s * kDrift_rad_s));
  information.tail<3>().setConstant(1 / (kScale * kScale));
  return information.asDiagonal();
}

}  // namespace

TimeOffsetSums::TimeOffsetSums(std::int64_t centre_ns)
    : centre_ns_(centre_ns), constants_(priorOfConstants()), solver_(constants_) {}

void TimeOffsetSums::add(const ComparedRotation& rotation) {
  const ImageRotation& by_tracks = rotation.by_tracks;
  const Eigen::Vector3d rotation_rad = rotationVectorOf(by_tracks.R_then_now);
  const double other_rad = kRotationNoise_rad + kCalibration * rotation_rad.norm();
  // A short way across looks like yaw or pitch of the camera, but not like roll.
  const double hidden_rad = rotation.displacement_sigma_m / kDepth_m;
  Eigen::Vector3d other_rad2 = Eigen::Vector3d::Constant(other_rad * other_rad);
  other_rad2.head<2>().array() += hidden_rad * hidden_rad;
  // As (information^-1 + others)^-1 where some directions have no information.
  const Eigen::Matrix3d softened = by_tracks.information * other_rad2.asDiagonal();
  const Eigen::Matrix3d information =
      (Eigen::Matrix3d::Identity() + softened).inverse() * by_tracks.information;
  if (!information.allFinite()) return;

  const Eigen::Quaterniond q_now_then(by_tracks.R_then_now.transpose());
  std::array<Eigen::Vector3d, kOffsetCount> differences_rad;
  for (std::size_t i = 0; i < kOffsetCount; ++i) {
    const Eigen::Quaterniond q_difference =
        rotation.then[i].conjugate() * rotation.now[i] * q_now_then;
    differences_rad[i] = std::copysign(2, q_difference.w()) * q_difference.vec();  // small
  }
  Eigen::Matrix<double, 3, 6> J;  // of a difference by the constant ones
  J << rotation.span_s * Eigen::Matrix3d::Identity(), Eigen::Matrix3d(rotation_rad.asDiagonal());
  const Eigen::Vector3d off_rad = differences_rad[best_] - J * constantsAt(best_);
  const double off = off_rad.dot(information * off_rad) / (kOutlierSigmas * kOutlierSigmas);
  const double weight = rotations_ < kFewestRotations ? 1 : 1 / ((1 + off) * (1 + off));

  const double passed_s = added_ns_ != 0 ? seconds(rotation.stamp_ns - added_ns_) : 0;
  added_ns_ = rotation.stamp_ns;
  const double kept = portable::exp(-passed_s / TimeOffsetEstimator::kMemory_s);
  for (std::size_t i = 0; i < kOffsetCount; ++i) {
    const Eigen::Vector3d weighed = weight * (information * differences_rad[i]);
    offsets_[i].squares = kept * offsets_[i].squares + differences_rad[i].dot(weighed);
    offsets_[i].gradient = kept * offsets_[i].gradient + J.transpose() * weighed;
  }
  const Matrix6d prior = priorOfConstants();
  constants_ = prior + kept * (constants_ - prior) + weight * J.transpose() * information * J;
  solver_.compute(constants_);
  rotations_ = kept * rotations_ + weight;
  rotation_squares_ =
      kept * rotation_squares_ + weight * rotation_rad.dot(information * rotation_rad);
  findMinimum();
}

Vector6d TimeOffsetSums::constantsAt(std::size_t offset) const {
  return solver_.solve(offsets_[offset].gradient);
}

void TimeOffsetSums::findMinimum() {
  for (std::size_t i = 0; i < kOffsetCount; ++i)
    squares_[i] = offsets_[i].squares - offsets_[i].gradient.dot(constantsAt(i));
  best_ = static_cast<std::size_t>(std::min_element(squares_.begin(), squares_.end()) -
                                   squares_.begin());
  estimate_ = {};
  if (rotations_ < kFewestRotations) return;
  const double per_rotation = std::max(squares_[best_], 0.0) / (3 * rotations_);
  const double ripple = std::sqrt(6 * rotations_) * per_rotation;  // by white noise of the attitude
  const double contrast = *std::max_element(squares_.begin(), squares_.end()) - squares_[best_];
  if (rotation_squares_ > kClearRotation * 3 * rotations_ && per_rotation > kAlike) {
    estimate_.state = TimeOffsetState::kDisagreement;
    return;
  }
  estimate_.state = TimeOffsetState::kTooLittleRotation;
  if (contrast < kSignificant * ripple) return;
  if (contrast > kTwoRotations * rotation_squares_)
    return;  // the odometry turned alone: its heading jumped
  if (best_ < kParabola || best_ + kParabola >= kOffsetCount) {
    estimate_.state = TimeOffsetState::kOutOfReach;
    return;
  }
  const Parabola parabola = parabolaThrough(&squares_[best_ - kParabola]);
  if (!(parabola.curvature > 0)) return;
  const double grid_s = seconds(TimeOffsetEstimator::kGrid_ns);
  const double half_s = static_cast<double>(kParabola) * grid_s;
  const double curvature_per_s2 = parabola.curvature / (grid_s * grid_s);
  const double by_rotations_s2 = kLikeNeighbours * per_rotation * 2 / curvature_per_s2;
  const double by_ripple_s = ripple / (half_s * curvature_per_s2);
  const double variance_s2 = by_rotations_s2 + by_ripple_s * by_ripple_s + kFloor_s * kFloor_s;
  if (variance_s2 > TimeOffsetEstimator::kSure_s * TimeOffsetEstimator::kSure_s) return;
  estimate_.state = TimeOffsetState::kKnown;
  estimate_.sigma_s = std::sqrt(variance_s2);
  const double minimum = static_cast<double>(best_) - parabola.slope / parabola.curvature;
  estimate_.offset_s = seconds(centre_ns_ - TimeOffsetEstimator::kReach_ns) + minimum * grid_s;
}

}  // namespace ardrone_vslam
