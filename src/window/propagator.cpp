// SPDX-License-Identifier: BSD-3-Clause
#include "window/propagator.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"
#include "window/odometry_noise.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kAttitude = WindowState::kAttitude;
constexpr int kBias = WindowState::kBias;
constexpr int kScale = WindowState::kScale;
constexpr int kExtrinsics = WindowState::kExtrinsics;
constexpr int kGlobals = WindowState::kGlobals;
constexpr int kFrame = WindowState::kFrame;

// Above this speed an error along the way counts as one of scale, which one camera cannot see.
constexpr double kSlowSpeed_m_s = 0.1;

}  // namespace

Propagator::Propagator(const OdometryNoiseConfig& config, const FrameIds& ids)
    : config_(config), ids_(ids), learned_(config) {
  validate(config);
}

void Propagator::start(const OdometryState& odometry, WindowState& state) {
  odometry_ = odometry;
  state.R_map_odom_.setIdentity();
  state.R_base_rig_.setIdentity();
  inflation_ = inflation_of_state_ = 1;
  learned_.reset();
  state.velocity_bias_m_s_.setZero();
  odometry_travelled_m_ = odometry.T_odom_base.translation().norm();  // at least
  state.scale_error_ = 0;
  state.floor_map_m_ = 0;
  state.anchors_.clear();
  state.frames_.assign(1, {ids_.take(state.anchors_, state.frames_), odometry.stamp_ns,
                           odometry.T_odom_base.translation(), odometry.T_odom_base.linear(),
                           Eigen::Vector3d::Zero(), odometry.height_m, 1});
  state.covariance_.reset(kGlobals + kFrame);
  setStart(config_, odometry.T_odom_base.linear(), state.covariance_.all());
}

void Propagator::returnTo(const Eigen::Isometry3d& T_map_odom, WindowState& state) {
  Clone& newest = state.frames_.back();
  const int to = state.frameCoordinate(0);
  const Eigen::Isometry3d T_map_base = T_map_odom * odometry_.T_odom_base;
  const Eigen::Vector3d jump_m = T_map_base.translation() - newest.position_map;
  const Eigen::Vector3d rotation_rad =
      rotationVectorOf(T_map_odom.linear() * state.R_map_odom_.transpose());
  newest.position_map = T_map_base.translation();
  newest.R_map_rig = T_map_base.linear() * state.R_base_rig_;
  state.R_map_odom_ = T_map_odom.linear();
  state.velocity_bias_m_s_.setZero();
  inflation_ = inflation_of_state_ = 1;
  learned_.reset();

  state.covariance_.clear(kBias, 3);
  auto P = state.covariance_.all();
  P.diagonal().segment<3>(kBias).setConstant(learned_.bias.variance());
  P.block<3, 3>(to, to) += jump_m * jump_m.transpose();
  const Eigen::Matrix3d rotation_variance = rotation_rad * rotation_rad.transpose();
  for (const int a : {kAttitude, to + 3})
    for (const int b : {kAttitude, to + 3}) P.block<3, 3>(a, b) += rotation_variance;
}

Eigen::Isometry3d Propagator::T_map_odom(const WindowState& state) const {
  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();
  T_map_odom.linear() = state.R_map_odom_;
  T_map_odom.translation() =
      state.frames_.back().position_map - state.R_map_odom_ * odometry_.T_odom_base.translation();
  return T_map_odom;
}

Eigen::Isometry3d Propagator::T_odom_base() const {
  Eigen::Isometry3d T_odom_base = odometry_.T_odom_base;
  T_odom_base.translation() = position_odom_m_;
  return T_odom_base;
}

double Propagator::biasSigmas(const WindowState& state) const {
  return config_.velocity_bias_m_s > 0 ? state.velocity_bias_m_s_.norm() / config_.velocity_bias_m_s
                                       : 0;
}

void Propagator::learnVelocityBias(const OdometryState& odometry, const WindowState& state) {
  constexpr double kLongest_s = 1;  // what was known before a hole does not stand for all of it
  const double duration_s =
      std::clamp(seconds(odometry.stamp_ns - odometry_.stamp_ns), 0.0, kLongest_s);
  learned_.bias.learn(state.velocityBias_m_s(), state.covariance().block<3, 3>(kBias, kBias),
                      inflation_of_state_, duration_s);
}

void Propagator::propagate(const OdometryState& odometry, const std::optional<OdometryStep>& step,
                           WindowState& state) {
  Increment increment;
  increment.duration_s = std::max(seconds(odometry.stamp_ns - odometry_.stamp_ns), 0.0);
  increment.displacement_odom_m =
      step ? step->motion_odom_m
           : odometry.T_odom_base.translation() - odometry_.T_odom_base.translation();
  increment.displacement_m = increment.displacement_odom_m.norm();

  Clone next;
  next.id = ids_.take(state.anchors_, state.frames_);
  next.stamp_ns = odometry.stamp_ns;
  next.height_m = odometry.height_m;
  addPosition(odometry, increment, next, state);
  odometry_travelled_m_ += increment.displacement_m;
  position_odom_m_ += increment.displacement_odom_m;
  if (step) {
    // Nothing but where the drone is now is in doubt: odometry that had stood still may catch up.
    const int to = state.frameCoordinate(state.frames_.size());
    auto P = state.covariance_.all();
    const Eigen::Vector3d jump_map = state.R_map_odom_ * step->jump_odom_m;
    P.block<3, 3>(to, to) += jump_map * jump_map.transpose();
    P.diagonal().segment<3>(to).array() += squared(step->motion_sigma_m);
  }
  propagateGlobals(odometry, increment, state);
  addAttitude(odometry, next, state);
  state.frames_.push_back(next);
  odometry_ = odometry;
}

void Propagator::addPosition(const OdometryState& odometry, const Increment& increment, Clone& next,
                             WindowState& state) const {
  const Eigen::Vector3d velocity_base_m_s =
      recentVelocity_base_m_s(state.frames(), state.R_base_rig());
  next.stretch_by_bias_s_m =
      velocity_base_m_s / (velocity_base_m_s.squaredNorm() + squared(kSlowSpeed_m_s));
  const Eigen::Vector3d step =
      state.R_map_odom_ * increment.displacement_odom_m *
      (1 - state.scale_error_ - next.stretch_by_bias_s_m.dot(state.velocity_bias_m_s_));
  const Eigen::Matrix3d bias_to_step =
      state.R_map_odom_ * odometry_.T_odom_base.linear() * increment.duration_s *
      (Eigen::Matrix3d::Identity() - velocity_base_m_s * next.stretch_by_bias_s_m.transpose());
  const Eigen::Vector3d moved = step - bias_to_step * state.velocity_bias_m_s_;
  next.position_map = state.newest().position_map + moved;

  const int from = state.frameCoordinate(state.frames_.size() - 1);
  const int to = state.frameCoordinate(state.frames_.size());
  state.covariance_.insert(to, kFrame);
  auto P = state.covariance_.all();
  Eigen::Matrix<double, 3, kGlobals> F = Eigen::Matrix<double, 3, kGlobals>::Zero();
  F.middleCols<3>(kAttitude) = -skew(moved);
  F.middleCols<3>(kBias) = -bias_to_step - moved * next.stretch_by_bias_s_m.transpose();
  F.col(kScale) = -moved;
  auto position = P.middleCols<3>(to);
  position = P.middleCols<3>(from);
  position.noalias() += P.leftCols<kGlobals>() * F.transpose();
  position.middleRows<3>(to) = position.middleRows<3>(from) + F * position.topRows<kGlobals>();
  P.middleRows<3>(to) = position.transpose();
  P.diagonal().segment<3>(to).array() += walkVariance_m2(
      config_, odometry_, odometry, increment.displacement_m, odometry_travelled_m_);
}

void Propagator::addAttitude(const OdometryState& odometry, Clone& next, WindowState& state) const {
  const int to = state.frameCoordinate(state.frames_.size());
  auto P = state.covariance_.all();
  const Eigen::Matrix3d R_map_base = state.R_map_odom_ * odometry.T_odom_base.linear();
  next.R_map_rig = R_map_base * state.R_base_rig_;
  auto attitude = P.middleCols<3>(to + 3);
  attitude = P.middleCols<3>(kAttitude);
  attitude.noalias() += P.middleCols<3>(kExtrinsics) * R_map_base.transpose();
  attitude.middleRows<3>(to + 3) =
      attitude.middleRows<3>(kAttitude) + R_map_base * attitude.middleRows<3>(kExtrinsics);
  P.middleRows<3>(to + 3) = attitude.transpose();
  P.diagonal().segment<3>(to + 3).array() += squared(radians(config_.attitude_noise_deg));
}

void Propagator::inflate(double factor, WindowState& state) {
  inflation_ = factor;
  if (factor <= inflation_of_state_) return;
  state.covariance_.all().diagonal().segment<3>(kBias).array() +=
      (factor - inflation_of_state_) * learned_.bias.variance();
  inflation_of_state_ = factor;
}

void Propagator::propagateGlobals(const OdometryState& odometry, const Increment& increment,
                                  WindowState& state) {
  const double dt_s = increment.duration_s;
  // Roll and pitch come back to the odometry's, which gravity holds; yaw walks; biases fade.
  const Eigen::Vector3d up = state.R_map_odom_ * odometry.T_odom_base.linear().col(2);
  const double keep_tilt = portable::exp(-dt_s / config_.tilt_time_s);
  const double keep_bias = portable::exp(-dt_s / config_.velocity_bias_time_s);
  state.R_map_odom_ =
      rotationOf(-(1 - keep_tilt) * acrossOf(up) * rotationVectorOf(state.R_map_odom_)) *
      state.R_map_odom_;
  state.velocity_bias_m_s_ *= keep_bias;

  const Eigen::Matrix3d keep_attitude =
      Eigen::Matrix3d::Identity() - (1 - keep_tilt) * acrossOf(up);
  auto P = state.covariance_.all();
  auto globals = P.leftCols<kGlobals>();
  globals.middleCols<3>(kAttitude) *= keep_attitude.transpose();
  globals.middleCols<3>(kBias) *= keep_bias;
  auto corner = P.topLeftCorner<kGlobals, kGlobals>();
  corner.middleRows<3>(kAttitude) = (keep_attitude * corner.middleRows<3>(kAttitude)).eval();
  corner.middleRows<3>(kBias) *= keep_bias;
  const double tilt_variance =
      squared(radians(config_.tilt_sigma_deg)) * (1 - keep_tilt * keep_tilt);
  const double yaw_variance = learned_.yaw.walk_rad2(dt_s, increment.displacement_m);
  const double bias_variance = inflation_ * learned_.bias.variance() * (1 - keep_bias * keep_bias);
  P.block<3, 3>(kAttitude, kAttitude) +=
      tilt_variance * acrossOf(up) + yaw_variance * up * up.transpose();
  P.diagonal().segment<3>(kBias).array() += bias_variance;
  inflation_of_state_ = inflation_ + (inflation_of_state_ - inflation_) * squared(keep_bias);
  const auto others = P.rows() - kGlobals;
  P.topRightCorner(kGlobals, others) = P.bottomLeftCorner(others, kGlobals).transpose();
}

}  // namespace ardrone_vslam
