// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/drone_model.hpp"

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam::drone_model {
namespace {

constexpr double kGravity_m_s2 = 9.81;

/// Base's true attitude but for yaw: the reported one, its tilt put right to first order.
Eigen::Matrix3d corrected(const Eigen::Matrix3d& R_reported, const State& x) {
  const Eigen::Vector3d tilt(x[kTilt], x[kTilt + 1], 0);
  return R_reported * (Eigen::Matrix3d::Identity() + skew(tilt));
}

/// Derivative of the former by one axis of the tilt.
Eigen::Matrix3d correctedBy(const Eigen::Matrix3d& R_reported, int axis) {
  return R_reported * skew(Eigen::Vector3d::Unit(axis));
}

/// Acceleration by thrust and drag, axes of base.
Eigen::Vector3d push(const State& x, const Eigen::Vector3d& velocity_base,
                     const Eigen::Vector3d& force_base) {
  return {-x[kDrag] * velocity_base.x(), -x[kDrag] * velocity_base.y(),
          force_base.z() - x[kForceBias + 2]};
}

const Eigen::Matrix3d kAcross = Eigen::Vector3d(1, 1, 0).asDiagonal();

}  // namespace

State motion(const State& x, const DroneMeasurement& measured, double dt_s) {
  const Eigen::Matrix3d R = corrected(measured.R_odom_base, x);
  const Eigen::Vector3d velocity = x.segment<3>(kVelocity);
  const Eigen::Vector3d acceleration =
      R * push(x, R.transpose() * velocity, measured.force_base_m_s2) -
      kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  State next = x;
  next.segment<3>(kPosition) +=
      rotationAboutZ(x[kYaw]) * (velocity * dt_s + 0.5 * dt_s * dt_s * acceleration);
  next.segment<3>(kVelocity) += dt_s * acceleration;
  return next;
}

Covariance motionJacobian(const State& x, const DroneMeasurement& measured, double dt_s) {
  const Eigen::Matrix3d R = corrected(measured.R_odom_base, x);
  const Eigen::Vector3d velocity = x.segment<3>(kVelocity);
  const Eigen::Vector3d velocity_base = R.transpose() * velocity;
  const Eigen::Vector3d push_base = push(x, velocity_base, measured.force_base_m_s2);
  // Of the acceleration.
  Eigen::Matrix<double, 3, kSize> A = Eigen::Matrix<double, 3, kSize>::Zero();
  A.middleCols<3>(kVelocity) = -x[kDrag] * R * kAcross * R.transpose();
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Matrix3d dR = correctedBy(measured.R_odom_base, axis);
    A.col(kTilt + axis) = dR * push_base - x[kDrag] * R * kAcross * dR.transpose() * velocity;
  }
  A.col(kForceBias + 2) = -R.col(2);
  A.col(kDrag) = -R * kAcross * velocity_base;

  const Eigen::Matrix3d rotation = rotationAboutZ(x[kYaw]);
  const Eigen::Vector3d acceleration = R * push_base - kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  Covariance F = Covariance::Identity();
  F.middleRows<3>(kPosition) += 0.5 * dt_s * dt_s * rotation * A;
  F.block<3, 3>(kPosition, kVelocity) += dt_s * rotation;
  F.block<3, 1>(kPosition, kYaw) += skew(Eigen::Vector3d::UnitZ()) * rotation *
                                    (velocity * dt_s + 0.5 * dt_s * dt_s * acceleration);
  F.middleRows<3>(kVelocity) += dt_s * A;
  return F;
}

Foreseen flow(const State& x, const Eigen::Matrix3d& R_reported) {
  const Eigen::Matrix3d R = corrected(R_reported, x);
  const Eigen::Vector3d velocity = x.segment<3>(kVelocity);
  const Eigen::Vector2d velocity_base = (R.transpose() * velocity).head<2>();
  const double scale = 1 + x[kFlowScale];
  Foreseen flow;
  flow.value = scale * velocity_base + x.segment<2>(kFlowBias);
  flow.jacobian.middleCols<3>(kVelocity) = scale * R.transpose().topRows<2>();
  for (int axis = 0; axis < 2; ++axis) {
    flow.jacobian.col(kTilt + axis) =
        scale * (correctedBy(R_reported, axis).transpose() * velocity).head<2>();
  }
  flow.jacobian.middleCols<2>(kFlowBias).setIdentity();
  flow.jacobian.col(kFlowScale) = velocity_base;
  return flow;
}

Foreseen drag(const State& x, const Eigen::Matrix3d& R_reported) {
  const Eigen::Matrix3d R = corrected(R_reported, x);
  const Eigen::Vector3d velocity = x.segment<3>(kVelocity);
  const Eigen::Vector2d velocity_base = (R.transpose() * velocity).head<2>();
  Foreseen drag;
  drag.value = -x[kDrag] * velocity_base + x.segment<2>(kForceBias);
  drag.jacobian.middleCols<3>(kVelocity) = -x[kDrag] * R.transpose().topRows<2>();
  for (int axis = 0; axis < 2; ++axis) {
    drag.jacobian.col(kTilt + axis) =
        -x[kDrag] * (correctedBy(R_reported, axis).transpose() * velocity).head<2>();
  }
  drag.jacobian.middleCols<2>(kForceBias).setIdentity();
  drag.jacobian.col(kDrag) = -velocity_base;
  return drag;
}

}  // namespace ardrone_vslam::drone_model
