// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/delayed_fusion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <sstream>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

/// Beyond it a variance means nothing, and its products with a lever arm might overflow.
constexpr double kLargestCorrectionVariance = 1e12;

double distance_m(const OdometryState& a, const OdometryState& b) {
  return (b.T_odom_base.translation() - a.T_odom_base.translation()).norm();
}

bool isPositiveSemiDefinite(const Matrix6d& covariance) {
  constexpr double kRounding = 1e-9;
  const Matrix6d symmetric = 0.5 * (covariance + covariance.transpose());
  if ((covariance - symmetric).cwiseAbs().maxCoeff() >
      kRounding * covariance.cwiseAbs().maxCoeff()) {
    return false;
  }
  // Metres and radians differ by orders of magnitude: judged as correlations.
  const Vector6d sigma = symmetric.diagonal().cwiseMax(0).cwiseSqrt();
  Matrix6d correlation = Matrix6d::Identity();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double scale = sigma[row] * sigma[column];
      if (scale > 0) {
        correlation(row, column) = symmetric(row, column) / scale;
      } else if (symmetric(row, column) != 0) {
        return false;  // a negative variance, or correlated with something that is known exactly
      }
    }
  }
  if (!correlation.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(correlation, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().minCoeff() >= -kRounding;
}

}  // namespace

std::string faultOf(const LateCorrection& c) {
  if (!c.T_map_base.matrix().allFinite() || !c.T_odom_base.matrix().allFinite() ||
      !c.covariance.allFinite()) {
    return "it is not finite";
  }
  const double farthest_m = std::max(c.T_map_base.translation().cwiseAbs().maxCoeff(),
                                     c.T_odom_base.translation().cwiseAbs().maxCoeff());
  std::ostringstream fault;
  if (farthest_m > kFarthestOdometry_m) {
    fault << "a position has a coordinate of " << farthest_m << " m, beyond " << kFarthestOdometry_m
          << " m; check odometry and mapper for divergence";
  } else if (c.covariance.diagonal().maxCoeff() > kLargestCorrectionVariance) {
    fault << "a variance of its fused pose is " << c.covariance.diagonal().maxCoeff() << ", above "
          << kLargestCorrectionVariance;
  } else if (!isPositiveSemiDefinite(c.covariance)) {
    fault << "the covariance of its fused pose is none: not symmetric or not positive";
  }
  return fault.str();
}

DelayedFusion::DelayedFusion(const DelayedFusionConfig& config)
    : config_(config), buffer_(config.odometry) {
  validate(config);
}

OdometryBuffer::Push DelayedFusion::push(const OdometryState& state) {
  if (!buffer_.empty() && state.start != buffer_.states().back().start) clear();
  const bool has_before = !buffer_.empty();
  const OdometryState before = has_before ? buffer_.states().back() : OdometryState{};
  const OdometryBuffer::Push answer = buffer_.push(state);
  if (answer == OdometryBuffer::Push::kAccepted && has_before)
    travelled_m_ += distance_m(before, state);
  return answer;
}

DelayedFusion::Answer DelayedFusion::correct(const LateCorrection& correction) {
  if (!faultOf(correction).empty()) return Answer::kBad;
  if (correction_ && correction.stamp_ns <= correction_->stamp_ns) return Answer::kNotAfter;
  OdometryState then;
  switch (buffer_.at(correction.stamp_ns, then)) {
    case OdometryBuffer::Lookup::kFound:
      break;
    case OdometryBuffer::Lookup::kEmpty:
    case OdometryBuffer::Lookup::kNotYet:
      return Answer::kNotYet;
    case OdometryBuffer::Lookup::kTooOld:
      return Answer::kTooOld;
    case OdometryBuffer::Lookup::kGap:
      return Answer::kGap;
  }
  const Eigen::Isometry3d difference = correction.T_odom_base.inverse() * then.T_odom_base;
  if (difference.translation().norm() > kLargestDifference_m ||
      angleOf_rad(difference.linear()) > kLargestDifference_rad) {
    return Answer::kOtherOdometry;
  }
  correction_ = correction;
  at_correction_ = then;
  T_map_odom_ = correction.T_map_base * correction.T_odom_base.inverse();
  travelled_m_ = 0;
  OdometryState before = then;
  for (const OdometryState& state : buffer_.states()) {
    if (state.stamp_ns <= then.stamp_ns) continue;
    travelled_m_ += distance_m(before, state);
    before = state;
  }
  return Answer::kUsed;
}

std::optional<MapState> DelayedFusion::newest() const {
  if (!correction_ || buffer_.empty()) return std::nullopt;
  return inMap(buffer_.states().back(), travelled_m_);
}

std::vector<MapState> DelayedFusion::sinceCorrection() const {
  std::vector<MapState> states;
  if (!correction_) return states;
  // Backwards: the oldest since the correction may have left the buffer.
  double travelled_m = travelled_m_;
  const auto& kept = buffer_.states();
  for (auto state = kept.rbegin(); state != kept.rend(); ++state) {
    if (state->stamp_ns < at_correction_.stamp_ns) break;
    states.push_back(inMap(*state, std::max(travelled_m, 0.0)));
    const auto older = std::next(state);
    if (older != kept.rend()) travelled_m -= distance_m(*older, *state);
  }
  std::reverse(states.begin(), states.end());
  return states;
}

void DelayedFusion::clear() {
  buffer_.clear();
  correction_.reset();
  T_map_odom_.setIdentity();
  travelled_m_ = 0;
}

MapState DelayedFusion::inMap(const OdometryState& state, double travelled_m) const {
  MapState result;
  result.stamp_ns = state.stamp_ns;
  result.T_map_base = T_map_odom_ * state.T_odom_base;
  result.twist_base = state.twist_base;
  result.twist_covariance = state.twist_covariance;
  // An error of the fused attitude turns the way since then.
  const Eigen::Vector3d moved_map =
      result.T_map_base.translation() - correction_->T_map_base.translation();
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -skew(moved_map);
  const Matrix6d sum = J * correction_->covariance * J.transpose() + growth(state, travelled_m);
  result.covariance = 0.5 * (sum + sum.transpose());
  return result;
}

Matrix6d DelayedFusion::growth(const OdometryState& state, double travelled_m) const {
  assert(state.stamp_ns >= at_correction_.stamp_ns && "growth is from the correction on");
  const double dt_s = seconds(state.stamp_ns - at_correction_.stamp_ns);
  const Eigen::Matrix3d& R_map_odom = T_map_odom_.linear();
  const Eigen::Vector3d step_map =
      R_map_odom * (state.T_odom_base.translation() - at_correction_.T_odom_base.translation());
  const std::optional<double> then_m2 = positionVariance_m2(at_correction_);
  const std::optional<double> now_m2 = positionVariance_m2(state);
  Matrix6d Q = Matrix6d::Zero();
  auto position = Q.topLeftCorner<3, 3>();
  if (then_m2 && now_m2 && *now_m2 > *then_m2) {
    // The diagonal alone: drivers fill the rest with anything, and an axis may not shrink.
    const Eigen::Vector3d grown_m2 =
        (state.covariance - at_correction_.covariance).diagonal().head<3>().cwiseMax(0);
    position = R_map_odom * grown_m2.asDiagonal() * R_map_odom.transpose();
  } else {
    position.diagonal().setConstant(squared(config_.walk_m_per_sqrt_m) * travelled_m +
                                    squared(config_.walk_m_per_sqrt_s) * dt_s);
  }
  position.diagonal().array() += squared(config_.velocity_bias_m_s * dt_s);
  position += squared(config_.scale_sigma) * step_map * step_map.transpose();
  const double keep_tilt = portable::exp(-dt_s / config_.tilt_time_s);
  const double tilt_rad2 = squared(radians(config_.tilt_sigma_deg)) * (1 - keep_tilt * keep_tilt);
  const double yaw_rad2 = squared(radians(config_.yaw_walk_deg_per_sqrt_s)) * dt_s +
                          squared(radians(config_.yaw_walk_deg_per_sqrt_m)) * travelled_m;
  Q.diagonal().tail<3>() << tilt_rad2, tilt_rad2, yaw_rad2;
  return Q;
}

}  // namespace ardrone_vslam
