// SPDX-License-Identifier: BSD-3-Clause
#include "window/window_state.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kStartSigma_m = 0.001;  // where the first frame is, map begins
// Above this speed an error along the way counts as one of scale, which one camera cannot see.
constexpr double kSlowSpeed_m_s = 0.1;

constexpr double kVelocitySpan_s = 2;

Eigen::Matrix3d acrossOf(const Eigen::Vector3d& unit) {
  return Eigen::Matrix3d::Identity() - unit * unit.transpose();
}

}  // namespace

std::optional<std::size_t> indexOf(const std::vector<Clone>& poses, std::uint32_t id) {
  const auto found =
      std::find_if(poses.begin(), poses.end(), [id](const Clone& pose) { return pose.id == id; });
  if (found == poses.end()) return std::nullopt;
  return static_cast<std::size_t>(found - poses.begin());
}

WindowState::WindowState(const OdometryNoiseConfig& config, bool attitude_states)
    : config_(config) {
  validate(config);
  if (attitude_states) return;
  config_.tilt_sigma_deg = 0;
  config_.yaw_walk_deg_per_sqrt_s = 0;
  config_.yaw_walk_deg_per_sqrt_m = 0;
  config_.attitude_noise_deg = 0;
  config_.extrinsics_sigma_deg = 0;
}

void WindowState::start(const OdometryState& odometry) {
  odometry_ = odometry;
  R_map_odom_.setIdentity();
  R_base_rig_.setIdentity();
  inflation_ = 1;
  velocity_bias_m_s_.setZero();
  odometry_way_m_ = odometry.T_odom_base.translation().norm();  // at least
  scale_error_ = 0;
  floor_map_m_ = 0;
  anchors_.clear();
  frames_.assign(1, {next_id_++, odometry.stamp_ns, odometry.T_odom_base.translation(),
                     odometry.T_odom_base.linear(), Eigen::Vector3d::Zero(), odometry.height_m, 1});
  covariance_.reset(kGlobals + kFrame);
  auto P = covariance_.all();
  P.diagonal().segment<3>(kBias).setConstant(squared(config_.velocity_bias_m_s));
  P(kScale, kScale) = squared(config_.scale_sigma);
  // Yaw is zero by definition; roll and pitch may be off from the start.
  const Eigen::Matrix3d tilt =
      squared(radians(config_.tilt_sigma_deg)) * acrossOf(odometry.T_odom_base.linear().col(2));
  const int attitude = kGlobals + 3;
  P.block<3, 3>(kAttitude, kAttitude) = tilt;
  P.block<3, 3>(attitude, kAttitude) = tilt;
  P.block<3, 3>(kAttitude, attitude) = tilt;
  P.block<3, 3>(attitude, attitude) = tilt;
  P.diagonal().segment<3>(kExtrinsics).setConstant(squared(radians(config_.extrinsics_sigma_deg)));
  P.block<3, 3>(attitude, kExtrinsics) =
      odometry.T_odom_base.linear() * P.block<3, 3>(kExtrinsics, kExtrinsics);
  P.block<3, 3>(kExtrinsics, attitude) = P.block<3, 3>(attitude, kExtrinsics).transpose();
  P.diagonal().segment<3>(attitude).array() +=
      squared(radians(config_.attitude_noise_deg)) + squared(radians(config_.extrinsics_sigma_deg));
  P.diagonal().segment<3>(kGlobals).setConstant(squared(kStartSigma_m));
}

void WindowState::returnTo(const Eigen::Isometry3d& T_map_odom) {
  Clone& newest = frames_.back();
  const int to = frameCoordinate(0);
  const Eigen::Isometry3d T_map_base = T_map_odom * odometry_.T_odom_base;
  const Eigen::Vector3d jump_m = T_map_base.translation() - newest.position_map;
  const Eigen::Vector3d rotation_rad =
      rotationVectorOf(T_map_odom.linear() * R_map_odom_.transpose());
  newest.position_map = T_map_base.translation();
  newest.R_map_rig = T_map_base.linear() * R_base_rig_;
  R_map_odom_ = T_map_odom.linear();
  velocity_bias_m_s_.setZero();
  inflation_ = 1;

  auto P = covariance_.all();
  P.middleRows<3>(kBias).setZero();
  P.middleCols<3>(kBias).setZero();
  P.diagonal().segment<3>(kBias).setConstant(squared(config_.velocity_bias_m_s));
  P.block<3, 3>(to, to) += jump_m * jump_m.transpose();
  const Eigen::Matrix3d turn_variance = rotation_rad * rotation_rad.transpose();
  for (const int a : {kAttitude, to + 3})
    for (const int b : {kAttitude, to + 3}) P.block<3, 3>(a, b) += turn_variance;
}

Eigen::Isometry3d WindowState::T_map_odom() const {
  Eigen::Isometry3d T_map_odom = Eigen::Isometry3d::Identity();
  T_map_odom.linear() = R_map_odom_;
  T_map_odom.translation() =
      frames_.back().position_map - R_map_odom_ * odometry_.T_odom_base.translation();
  return T_map_odom;
}

double WindowState::biasSigmas() const {
  return config_.velocity_bias_m_s > 0 ? velocity_bias_m_s_.norm() / config_.velocity_bias_m_s : 0;
}

void WindowState::propagate(const OdometryState& odometry,
                            const std::optional<OdometryStep>& step_in_it) {
  const Clone last = frames_.back();
  const double dt_s =
      std::max(static_cast<double>(odometry.stamp_ns - odometry_.stamp_ns) * 1e-9, 0.0);
  const Eigen::Vector3d step_odom =
      step_in_it ? step_in_it->motion_odom_m
                 : odometry.T_odom_base.translation() - odometry_.T_odom_base.translation();
  const double displacement_m = step_odom.norm();
  const Eigen::Vector3d velocity_base_m_s = recentVelocity_base_m_s();

  Clone next;
  next.id = next_id_++;
  next.stamp_ns = odometry.stamp_ns;
  next.height_m = odometry.height_m;
  next.stretch_by_bias_s_m =
      velocity_base_m_s / (velocity_base_m_s.squaredNorm() + squared(kSlowSpeed_m_s));
  const Eigen::Vector3d step =
      R_map_odom_ * step_odom *
      (1 - scale_error_ - next.stretch_by_bias_s_m.dot(velocity_bias_m_s_));
  const Eigen::Matrix3d bias_to_step =
      R_map_odom_ * odometry_.T_odom_base.linear() * dt_s *
      (Eigen::Matrix3d::Identity() - velocity_base_m_s * next.stretch_by_bias_s_m.transpose());
  const Eigen::Vector3d moved = step - bias_to_step * velocity_bias_m_s_;
  next.position_map = last.position_map + moved;

  const int from = frameCoordinate(frames_.size() - 1);
  const int to = frameCoordinate(frames_.size());
  covariance_.insert(to, kFrame);
  auto P = covariance_.all();
  Eigen::Matrix<double, 3, kGlobals> F = Eigen::Matrix<double, 3, kGlobals>::Zero();
  F.middleCols<3>(kAttitude) = -skew(moved);
  F.middleCols<3>(kBias) = -bias_to_step - moved * next.stretch_by_bias_s_m.transpose();
  F.col(kScale) = -moved;
  auto position = P.middleCols<3>(to);
  position = P.middleCols<3>(from);
  position.noalias() += P.leftCols<kGlobals>() * F.transpose();
  position.middleRows<3>(to) = position.middleRows<3>(from) + F * position.topRows<kGlobals>();
  P.middleRows<3>(to) = position.transpose();
  P.diagonal().segment<3>(to).array() += walkVariance_m2(odometry, dt_s, displacement_m);
  odometry_way_m_ += displacement_m;
  if (step_in_it) {
    // Nothing but where the drone is now is in doubt: odometry that had stood still may catch up.
    const Eigen::Vector3d jump_map = R_map_odom_ * step_in_it->step_odom_m;
    P.block<3, 3>(to, to) += jump_map * jump_map.transpose();
    P.diagonal().segment<3>(to).array() += squared(step_in_it->motion_sigma_m);
  }

  propagateGlobals(odometry, dt_s, displacement_m);
  const Eigen::Matrix3d R_map_base = R_map_odom_ * odometry.T_odom_base.linear();
  next.R_map_rig = R_map_base * R_base_rig_;
  auto attitude = P.middleCols<3>(to + 3);
  attitude = P.middleCols<3>(kAttitude);
  attitude.noalias() += P.middleCols<3>(kExtrinsics) * R_map_base.transpose();
  attitude.middleRows<3>(to + 3) =
      attitude.middleRows<3>(kAttitude) + R_map_base * attitude.middleRows<3>(kExtrinsics);
  P.middleRows<3>(to + 3) = attitude.transpose();
  P.diagonal().segment<3>(to + 3).array() += squared(radians(config_.attitude_noise_deg));
  frames_.push_back(next);
  odometry_ = odometry;
}

double WindowState::walkVariance_m2(const OdometryState& odometry, double dt_s,
                                    double displacement_m) const {
  const double configured_m2 = squared(config_.walk_m_per_sqrt_m) * displacement_m +
                               squared(config_.walk_m_per_sqrt_s) * dt_s;
  const std::optional<double> then = positionVariance_m2(odometry_);
  const std::optional<double> now = positionVariance_m2(odometry);
  if (!then || !now || !(*now > *then)) return configured_m2;
  // Of what the odometry says of itself the slow velocity error and that of the scale, which grows
  // with the square of the way, are states of their own here. Taken for white noise a second time,
  // they would leave the camera hardly anything to go by.
  const double by_bias_m2 =
      2 * squared(config_.velocity_bias_m_s) * config_.velocity_bias_time_s * dt_s;
  const double by_scale_m2 = squared(config_.scale_sigma) *
                             (squared(odometry_way_m_ + displacement_m) - squared(odometry_way_m_));
  const double rest_m2 = *now - *then - by_bias_m2 - by_scale_m2;
  return std::max(rest_m2, std::min(configured_m2, *now - *then));
}

// Of the corrected poses: the odometry's noise would make the velocity jitter, and the bias, which
// counts as across the way or along it, would seem to be seen.
Eigen::Vector3d WindowState::recentVelocity_base_m_s() const {
  Eigen::Vector3d displacement_base_m = Eigen::Vector3d::Zero();
  double passed_s = 0;
  for (std::size_t i = frames_.size() - 1; i-- > 0 && passed_s < kVelocitySpan_s;) {
    displacement_base_m += R_base_rig_ * frames_[i].R_map_rig.transpose() *
                           (frames_[i + 1].position_map - frames_[i].position_map);
    passed_s = static_cast<double>(frames_.back().stamp_ns - frames_[i].stamp_ns) * 1e-9;
  }
  return passed_s > 0 ? Eigen::Vector3d(displacement_base_m / passed_s) : Eigen::Vector3d::Zero();
}

void WindowState::inflate(double factor) {
  const double more = (factor - inflation_) * squared(config_.velocity_bias_m_s);
  inflation_ = factor;
  if (more <= 0) return;
  covariance_.all().diagonal().segment<3>(kBias).array() += more;
}

void WindowState::propagateGlobals(const OdometryState& odometry, double dt_s,
                                   double displacement_m) {
  // Roll and pitch come back to the odometry's, which gravity holds; yaw walks; biases fade.
  const Eigen::Vector3d up = R_map_odom_ * odometry.T_odom_base.linear().col(2);
  const double keep_tilt = std::exp(-dt_s / config_.tilt_time_s);
  const double keep_bias = std::exp(-dt_s / config_.velocity_bias_time_s);
  R_map_odom_ =
      rotationOf(-(1 - keep_tilt) * acrossOf(up) * rotationVectorOf(R_map_odom_)) * R_map_odom_;
  velocity_bias_m_s_ *= keep_bias;

  const Eigen::Matrix3d keep_attitude =
      Eigen::Matrix3d::Identity() - (1 - keep_tilt) * acrossOf(up);
  auto P = covariance_.all();
  auto globals = P.leftCols<kGlobals>();
  globals.middleCols<3>(kAttitude) *= keep_attitude.transpose();
  globals.middleCols<3>(kBias) *= keep_bias;
  auto corner = P.topLeftCorner<kGlobals, kGlobals>();
  corner.middleRows<3>(kAttitude) = (keep_attitude * corner.middleRows<3>(kAttitude)).eval();
  corner.middleRows<3>(kBias) *= keep_bias;
  const double tilt_variance =
      squared(radians(config_.tilt_sigma_deg)) * (1 - keep_tilt * keep_tilt);
  const double yaw_variance = squared(radians(config_.yaw_walk_deg_per_sqrt_s)) * dt_s +
                              squared(radians(config_.yaw_walk_deg_per_sqrt_m)) * displacement_m;
  const double bias_variance =
      inflation_ * squared(config_.velocity_bias_m_s) * (1 - keep_bias * keep_bias);
  P.block<3, 3>(kAttitude, kAttitude) +=
      tilt_variance * acrossOf(up) + yaw_variance * up * up.transpose();
  P.diagonal().segment<3>(kBias).array() += bias_variance;
  const auto others = P.rows() - kGlobals;
  P.topRightCorner(kGlobals, others) = P.bottomLeftCorner(others, kGlobals).transpose();
}

void WindowState::holdNewest(std::size_t reference, const Eigen::Vector3d& camera_base,
                             const Eigen::Matrix3d& sigma_m2) {
  const Clone& then = frames_[reference];
  Clone& newest = frames_.back();
  const Eigen::Vector3d lever_then = then.R_map_rig * camera_base;
  const Eigen::Vector3d lever = newest.R_map_rig * camera_base;
  newest.position_map = then.position_map + lever_then - lever;
  const int from = frameCoordinate(reference);
  const int to = frameCoordinate(frames_.size() - 1);
  auto P = covariance_.all();
  P.middleRows<3>(to) = (P.middleRows<3>(from) - skew(lever_then) * P.middleRows<3>(from + 3) +
                         skew(lever) * P.middleRows<3>(to + 3))
                            .eval();
  P.middleCols<3>(to) =
      (P.middleCols<3>(from) - P.middleCols<3>(from + 3) * skew(lever_then).transpose() +
       P.middleCols<3>(to + 3) * skew(lever).transpose())
          .eval();
  P.block<3, 3>(to, to) += sigma_m2;
}

void WindowState::beginFloor(double height_m, double variance_m2) {
  floor_map_m_ = frames_.back().position_map.z() - height_m;
  covariance_.copy(frameCoordinate(frames_.size() - 1) + 2, kFloor, 1);
  covariance_.all()(kFloor, kFloor) += variance_m2;
}

void WindowState::removeFrame(std::size_t frame) {
  covariance_.remove(frameCoordinate(frame), kFrame);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(frame));
}

void WindowState::makeAnchor(std::size_t frame) {
  const int anchor = anchorCoordinate(anchors_.size());
  covariance_.insert(anchor, kAnchor);
  covariance_.copy(frameCoordinate(frame) + kAnchor, anchor, kFrame);
  auto P = covariance_.all();
  const int stretch = anchor + kFrame;
  const Eigen::Vector3d& by_bias_s_m = frames_[frame].stretch_by_bias_s_m;
  P.col(stretch) = P.middleCols<3>(kBias) * by_bias_s_m;
  P(stretch, stretch) = by_bias_s_m.dot(P.block<3, 1>(kBias, stretch));
  P.row(stretch) = P.col(stretch).transpose();
  anchors_.push_back(frames_[frame]);
  removeFrame(frame);
}

void WindowState::removeAnchor(std::size_t anchor) {
  covariance_.remove(anchorCoordinate(anchor), kAnchor);
  anchors_.erase(anchors_.begin() + static_cast<std::ptrdiff_t>(anchor));
}

}  // namespace ardrone_vslam
