// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/drone_filter.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// Of accelerations that nobody measured [m/s^2/sqrt(Hz)].
constexpr double kInterpolatedNoise = 0.5;
constexpr double kCommandedNoise = 0.2;
constexpr double kForceBiasTime_s = 600;   // in which the accelerometer's bias may become another
constexpr double kEchoes_hz = 25;          // of the sonar; heights in between are no new ones
constexpr double kLongestSample_s = 0.07;  // of a packet: 15 Hz
constexpr double kStartVelocity_m_s = 0.3;
constexpr double kRestVelocity_m_s = 0.01;
constexpr double kSameFloor_m = 0.1;
constexpr double kAttitudeNoise_rad = 2e-3;  // white, of what is reported
constexpr double kLeastVariance = 1e-12;

using namespace drone_model;
using Row = Eigen::Matrix<double, 1, kSize>;

}  // namespace

void DroneFilter::begin(const DroneMeasurement& measured) {
  x_.setZero();
  x_[kPosition + 2] = std::max(measured.height_m, 0.0);
  x_.segment<3>(kVelocity) = measured.R_odom_base * Eigen::Vector3d(measured.flow_base_m_s.x(),
                                                                    measured.flow_base_m_s.y(), 0);
  x_[kDrag] = errors_.drag_per_s;
  State sigma = State::Zero();
  sigma[kPosition + 2] = errors_.height_noise_m;
  sigma.segment<3>(kVelocity).setConstant(kStartVelocity_m_s);
  sigma.segment<2>(kTilt).setConstant(radians(errors_.tilt_sigma_deg));
  sigma.segment<2>(kFlowBias).setConstant(errors_.flow_bias_m_s);
  sigma[kFlowScale] = errors_.flow_scale_sigma;
  sigma.segment<3>(kForceBias).setConstant(errors_.force_bias_m_s2);
  sigma[kDrag] = errors_.drag_sigma_per_s;
  P_ = sigma.cwiseAbs2().cwiseMax(kLeastVariance).asDiagonal();
}

void DroneFilter::predict(const DroneMeasurement& measured, double dt_s, Known known) {
  const Covariance F = motionJacobian(x_, measured, dt_s);
  x_ = motion(x_, measured, dt_s);
  P_ = F * P_ * F.transpose();
  const double guessed = known == Known::kMeasured    ? 0
                         : known == Known::kCommanded ? kCommandedNoise
                                                      : kInterpolatedNoise;
  const double measured_noise =
      portable::hypot(errors_.gust_m_s2_per_sqrt_hz, errors_.force_noise_m_s2_per_sqrt_hz);
  addNoise(dt_s, std::max(measured_noise, guessed));
}

void DroneFilter::rest(double dt_s) {
  x_.segment<3>(kVelocity).setZero();
  P_.middleRows<3>(kVelocity).setZero();
  P_.middleCols<3>(kVelocity).setZero();
  P_.diagonal().segment<3>(kVelocity).setConstant(squared(kRestVelocity_m_s));
  addNoise(dt_s, 0);
}

/// White accelerations, and what the slow errors forget and gain in this time.
void DroneFilter::addNoise(double dt_s, double acceleration_noise) {
  State keep = State::Ones();
  keep.segment<2>(kTilt).setConstant(portable::exp(-dt_s / errors_.tilt_time_s));
  keep.segment<2>(kFlowBias).setConstant(portable::exp(-dt_s / errors_.flow_bias_time_s));
  x_ = keep.cwiseProduct(x_);
  P_ = keep.asDiagonal() * P_ * keep.asDiagonal();
  const double tilt = squared(radians(errors_.tilt_sigma_deg));
  P_.diagonal().segment<2>(kTilt).array() += tilt * (1 - squared(keep[kTilt]));
  P_.diagonal().segment<2>(kFlowBias).array() +=
      squared(errors_.flow_bias_m_s) * (1 - squared(keep[kFlowBias]));
  P_.diagonal().segment<3>(kForceBias).array() +=
      squared(errors_.force_bias_m_s2) * dt_s / kForceBiasTime_s;
  P_(kYaw, kYaw) += squared(radians(errors_.yaw_walk_deg_per_sqrt_s)) * dt_s;
  const double q = squared(acceleration_noise);
  P_.diagonal().segment<3>(kVelocity).array() += q * dt_s;
  P_.diagonal().segment<3>(kPosition).array() += q * dt_s * dt_s * dt_s / 3;
  for (int axis = 0; axis < 3; ++axis) {
    P_(kPosition + axis, kVelocity + axis) += q * dt_s * dt_s / 2;
    P_(kVelocity + axis, kPosition + axis) += q * dt_s * dt_s / 2;
  }
}

void DroneFilter::updateVelocity(const DroneMeasurement& measured, double dt_s) {
  const double sample_s = std::min(dt_s, kLongestSample_s);
  for (int axis = 0; axis < 2; ++axis) {
    const Foreseen seen = flow(x_, measured.R_odom_base);
    update(measured.flow_base_m_s[axis] - seen.value[axis], seen.jacobian.row(axis),
           squared(errors_.flow_noise_m_s_per_sqrt_hz) / sample_s);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const Foreseen felt = drag(x_, measured.R_odom_base);
    update(
        measured.force_base_m_s2[axis] - felt.value[axis], felt.jacobian.row(axis),
        (squared(errors_.force_noise_m_s2_per_sqrt_hz) + squared(errors_.gust_m_s2_per_sqrt_hz)) /
            sample_s);
  }
}

double DroneFilter::heightInnovation_m(double height_m) const {
  return height_m - (x_[kPosition + 2] - x_[kFloor]);
}

double DroneFilter::heightSigma_m() const {
  constexpr int kZ = kPosition + 2;
  const double variance_m2 = P_(kZ, kZ) + P_(kFloor, kFloor) - 2 * P_(kZ, kFloor);
  return std::sqrt(std::max(variance_m2, 0.0) + squared(errors_.height_noise_m));
}

void DroneFilter::updateHeight(double height_m, double dt_s) {
  Row H = Row::Zero();
  H[kPosition + 2] = 1;
  H[kFloor] = -1;
  update(heightInnovation_m(height_m), H,
         squared(errors_.height_noise_m) * std::max(1.0, 1 / (kEchoes_hz * dt_s)));
}

void DroneFilter::changeFloor(double floor_m) {
  constexpr int kZ = kPosition + 2;
  const bool is_first = std::abs(floor_m) < std::max(kSameFloor_m, kTableStep_m / 2);
  P_.row(kFloor).setZero();
  P_.col(kFloor).setZero();
  x_[kFloor] = is_first ? 0 : floor_m;
  if (!is_first) {  // floor = z - height
    P_.row(kFloor) = P_.row(kZ);
    P_.col(kFloor) = P_.col(kZ);
    P_(kFloor, kFloor) = P_(kZ, kZ);
  }
  P_(kFloor, kFloor) += is_first ? kLeastVariance : squared(errors_.height_noise_m);
}

void DroneFilter::widen(double position_m, double velocity_m_s) {
  P_.diagonal().segment<3>(kPosition).array() += squared(position_m);
  P_.diagonal().segment<3>(kVelocity).array() += squared(velocity_m_s);
}

void DroneFilter::update(double innovation, const Row& H, double variance) {
  const State PHt = P_ * H.transpose();
  const double S = H * PHt + variance;
  // What is above this many sigmas says little of where the drone is.
  constexpr double kMost = 5;
  const double bounded = std::clamp(innovation, -kMost * std::sqrt(S), kMost * std::sqrt(S));
  x_ += PHt * (bounded / S);
  P_ -= PHt * PHt.transpose() / S;
  x_[kYaw] = 0;
}

OdometryState DroneFilter::observed(const Eigen::Matrix3d& R_reported) const {
  OdometryState state;
  const Eigen::Vector3d tilt(x_[kTilt], x_[kTilt + 1], 0);
  const Eigen::Matrix3d R = R_reported * rotationOf(tilt);
  state.T_odom_base.linear() = R;
  state.T_odom_base.translation() = x_.segment<3>(kPosition);
  state.twist_base.head<3>() = R.transpose() * x_.segment<3>(kVelocity);
  Eigen::Matrix<double, 6, kSize> J = Eigen::Matrix<double, 6, kSize>::Zero();
  J.block<3, 3>(0, kPosition).setIdentity();
  J.block<3, 2>(3, kTilt) = R.leftCols<2>();
  J.block<3, 1>(3, kYaw) = Eigen::Vector3d::UnitZ();
  const Matrix6d covariance = J * P_ * J.transpose();
  state.covariance = 0.5 * (covariance + covariance.transpose());
  state.covariance.diagonal().tail<3>().array() += squared(kAttitudeNoise_rad);
  state.twist_covariance.topLeftCorner<3, 3>() =
      R.transpose() * P_.block<3, 3>(kVelocity, kVelocity) * R;
  return state;
}

}  // namespace ardrone_vslam
