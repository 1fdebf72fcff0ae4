// SPDX-License-Identifier: BSD-3-Clause
#include "drone_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr double kLongestStep_s = 0.002;
constexpr double kLandingSpeed_m_s = 0.4;
constexpr double kTakeOffPerSecond = 1;  // climb per missing height

double cut(double command) {
  return std::min(std::max(command, -1.0), 1.0);
}

}  // namespace

void DroneModel::Follower::step(double wanted, double time_s, double dt_s) {
  const double share = 1 - std::exp(-dt_s / time_s);
  between += share * (wanted - between);
  value += share * (between - value);
}

DroneModel::DroneModel(const FlightStart& start, const DroneLimits& limits)
    : limits_(limits), yaw_rad_(start.yaw_rad) {
  state_.T_world_body = Eigen::Translation3d(start.x_m, start.y_m, 0) *
                        Eigen::AngleAxisd(yaw_rad_, Eigen::Vector3d::UnitZ());
}

void DroneModel::takeOff() {
  if (phase_ == Phase::kLanded) phase_ = Phase::kTakingOff;
}

void DroneModel::land() {
  if (phase_ == Phase::kFlying || phase_ == Phase::kTakingOff) phase_ = Phase::kLanding;
}

void DroneModel::advance(double seconds, const DroneCommand& command) {
  assert(seconds >= 0 && "time does not go back");
  const int steps = static_cast<int>(std::ceil(seconds / kLongestStep_s - 1e-9));
  for (int i = 0; i < steps; ++i) step(seconds / steps, command);
}

double DroneModel::wantedClimb(const DroneCommand& command) const {
  switch (phase_) {
    case Phase::kTakingOff: {
      const double missing_m = limits_.take_off_m - state_.T_world_body.translation().z();
      return std::min(limits_.climb_m_s, kTakeOffPerSecond * std::max(missing_m, 0.05));
    }
    case Phase::kLanding:
      return -kLandingSpeed_m_s;
    default:
      return limits_.climb_m_s * cut(command.up);
  }
}

void DroneModel::step(double dt_s, const DroneCommand& command) {
  if (phase_ == Phase::kLanded) return;
  const bool obeys = phase_ == Phase::kFlying;
  const DroneCommand obeyed = obeys ? command : DroneCommand{};

  const double turn_share = 1 - std::exp(-dt_s / limits_.turn_time_s);
  turn_rad_s_ += turn_share * (limits_.turn_rad_s * cut(obeyed.turn_left) - turn_rad_s_);
  yaw_rad_ += turn_rad_s_ * dt_s;
  const Eigen::Vector3d forward(std::cos(yaw_rad_), std::sin(yaw_rad_), 0);
  const Eigen::Vector3d left(-forward.y(), forward.x(), 0);

  const double steepest = std::tan(limits_.tilt_rad);
  const auto wantedTilt = [&](double asked, double speed_m_s) {
    const double braking = -limits_.brake_per_s * speed_m_s / kGravity_m_s2;
    return steepest * cut(asked != 0 ? asked : braking / steepest);
  };
  const Eigen::Vector3d before = state_.velocity_world_m_s;
  tilt_forward_.step(wantedTilt(obeyed.forward, before.dot(forward)), limits_.tilt_time_s, dt_s);
  tilt_left_.step(wantedTilt(obeyed.left, before.dot(left)), limits_.tilt_time_s, dt_s);
  const double climbed = climb_.value;
  climb_.step(wantedClimb(obeyed), limits_.climb_time_s, dt_s);

  // Thrust leans by these tangents and carries the drone's weight and its climb.
  const double lift = kGravity_m_s2 + (climb_.value - climbed) / dt_s + kDrag_per_s * before.z();
  const Eigen::Vector3d thrust =
      lift * (tilt_forward_.value * forward + tilt_left_.value * left + Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d acceleration =
      thrust - kDrag_per_s * before - kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d R_before = state_.T_world_body.linear();
  state_.T_world_body.translation() += before * dt_s + 0.5 * acceleration * dt_s * dt_s;
  state_.velocity_world_m_s = before + acceleration * dt_s;
  state_.acceleration_world_m_s2 = acceleration;
  state_.T_world_body.linear() = attitudeOf(thrust, yaw_rad_);
  const Eigen::AngleAxisd turn(R_before.transpose() * state_.T_world_body.linear());
  state_.turn_rate_body_rad_s = turn.axis() * (turn.angle() / dt_s);

  const double height_m = state_.T_world_body.translation().z();
  if (phase_ == Phase::kTakingOff && height_m >= limits_.take_off_m) phase_ = Phase::kFlying;
  if (height_m <= 0 && state_.velocity_world_m_s.z() < 0) {
    FlightStart place{state_.T_world_body.translation().x(), state_.T_world_body.translation().y(),
                      yaw_rad_};
    *this = DroneModel(place, limits_);
  }
}

}  // namespace ardrone_vslam
