// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "ardrone_vslam/drone_observer.hpp"

/// How the drone moves and what its sensors should report, with the derivatives: DroneFilter's
/// equations. Thrust is along base's z, so its tilt tells the acceleration, and what the
/// accelerometer feels across it is the air's drag, which tells the velocity: Martin and Salaun,
/// The true role of accelerometer feedback in quadrotor control, 2010. odom has z up; its x axis is
/// that of the reported yaw's zero.
namespace ardrone_vslam::drone_model {

/// Where in the state: position [m] and velocity [m/s] of base, the latter turned by the yaw's
/// error; what is to be put right of the reported tilt (rotation vector, axes of base) [rad];
/// errors of the flow, of the accelerometer; drag [1/s]; height of the floor below [m]; the
/// reported yaw's error [rad], always estimated as zero.
enum Index {
  kPosition = 0,
  kVelocity = 3,
  kTilt = 6,
  kFlowBias = 8,
  kFlowScale = 10,
  kForceBias = 11,
  kDrag = 14,
  kFloor = 15,
  kYaw = 16,
  kSize = 17
};
/// Means, placed by Index.
using State = Eigen::Matrix<double, kSize, 1>;
/// Of the State's errors, placed by Index.
using Covariance = Eigen::Matrix<double, kSize, kSize>;
/// Derivative of two quantities by the State.
using Rows2 = Eigen::Matrix<double, 2, kSize>;

/// What a measurement should be, and its derivative by the state.
struct Foreseen {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();  ///< forward and left, in the measurement's unit
  Rows2 jacobian = Rows2::Zero();                   ///< of value by the State
};

/// The state after dt_s.
State motion(const State& x, const DroneMeasurement& measured, double dt_s);
/// Derivative of motion() by x.
Covariance motionJacobian(const State& x, const DroneMeasurement& measured, double dt_s);
/// What the optical flow should report: base's velocity, forward and left [m/s].
Foreseen flow(const State& x, const Eigen::Matrix3d& R_reported);
/// What the accelerometer should feel across the thrust, forward and left [m/s^2].
Foreseen drag(const State& x, const Eigen::Matrix3d& R_reported);

}  // namespace ardrone_vslam::drone_model
