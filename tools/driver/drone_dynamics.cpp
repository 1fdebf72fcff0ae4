// SPDX-License-Identifier: BSD-3-Clause
#include "driver/drone_dynamics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ardrone_vslam {
namespace {

constexpr double kLongestStep_s = 0.002;
constexpr double kLandingSpeed_m_s = 0.4;
constexpr double kTakeOffPerSecond = 1;  // climb per missing height

double cut(double command) {
  return std::min(std::max(command, -1.0), 1.0);
}

}  // namespace

void DroneDynamics::Follower::step(double wanted, double time_s, double dt_s) {
  const double share = 1 - std::exp(-dt_s / time_s);
  between += share * (wanted - between);
  value += share * (between - value);
}

DroneDynamics::DroneDynamics(const FlightStart& start, const DroneLimits& limits)
    : limits_(limits), yaw_rad_(start.yaw_rad) {
  state_.T_world_body.translation() << start.x_m, start.y_m, 0;
  standDown();
}

/// On the floor, below where it is.
void DroneDynamics::standDown() {
  phase_ = Phase::kLanded;
  yaw_rate_rad_s_ = 0;
  tilt_forward_ = tilt_left_ = climb_ = Follower();
  Eigen::Vector3d place = state_.T_world_body.translation();
  place.z() = limits_.stands_m;
  state_ = FlightState();
  state_.T_world_body =
      Eigen::Translation3d(place) * Eigen::AngleAxisd(yaw_rad_, Eigen::Vector3d::UnitZ());
}

void DroneDynamics::takeOff() {
  if (phase_ == Phase::kLanded) phase_ = Phase::kTakingOff;
}

void DroneDynamics::land() {
  if (phase_ == Phase::kFlying || phase_ == Phase::kTakingOff) phase_ = Phase::kLanding;
}

void DroneDynamics::cutMotors() {
  if (phase_ != Phase::kLanded) phase_ = Phase::kFalling;
}

void DroneDynamics::keepWithin(const Eigen::AlignedBox3d& space) {
  space_ = space;
  space_.min().z() = -std::numeric_limits<double>::infinity();  // the floor is where it stands
}

void DroneDynamics::advance(double seconds, const DroneCommand& command) {
  assert(seconds >= 0 && "time does not go back");
  const int steps = static_cast<int>(std::ceil(seconds / kLongestStep_s - 1e-9));
  for (int i = 0; i < steps; ++i) step(seconds / steps, command);
}

double DroneDynamics::wantedClimb(const DroneCommand& command) const {
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

/// Per mass [m/s^2, world].
Eigen::Vector3d DroneDynamics::thrust(double dt_s, const DroneCommand& command) {
  const bool brakes = command.auto_hover && command.isZero();
  const Eigen::Vector3d forward(std::cos(yaw_rad_), std::sin(yaw_rad_), 0);
  const Eigen::Vector3d left(-forward.y(), forward.x(), 0);
  const double steepest = std::tan(limits_.tilt_rad);
  const Eigen::Vector3d velocity = state_.velocity_world_m_s;
  const auto wantedTilt = [&](double asked, double speed_m_s) {
    const double braking = -limits_.brake_per_s * speed_m_s / kGravity_m_s2;
    return steepest * cut(brakes ? braking / steepest : asked);
  };
  tilt_forward_.step(wantedTilt(command.forward, velocity.dot(forward)), limits_.tilt_time_s, dt_s);
  tilt_left_.step(wantedTilt(command.left, velocity.dot(left)), limits_.tilt_time_s, dt_s);
  const double climbed = climb_.value;
  climb_.step(wantedClimb(command), limits_.climb_time_s, dt_s);
  // It leans by these tangents and carries the drone's weight and its climb.
  const double lift = kGravity_m_s2 + (climb_.value - climbed) / dt_s + kDrag_per_s * velocity.z();
  return lift *
         (tilt_forward_.value * forward + tilt_left_.value * left + Eigen::Vector3d::UnitZ());
}

void DroneDynamics::stopAtWalls() {
  if (space_.isEmpty()) return;
  const Eigen::Vector3d place = state_.T_world_body.translation();
  state_.T_world_body.translation() = place.cwiseMax(space_.min()).cwiseMin(space_.max());
  for (Eigen::Index i = 0; i < 3; ++i) {
    double& speed_m_s = state_.velocity_world_m_s[i];
    if (place[i] > space_.max()[i]) speed_m_s = std::min(speed_m_s, 0.0);
    if (place[i] < space_.min()[i]) speed_m_s = std::max(speed_m_s, 0.0);
  }
  // It holds its speed, not its height: what the ceiling took is not to be missed later.
  if (place.z() > space_.max().z()) climb_ = {};
}

void DroneDynamics::step(double dt_s, const DroneCommand& command) {
  if (phase_ == Phase::kLanded) return;
  const DroneCommand obeyed = phase_ == Phase::kFlying ? command : DroneCommand{};
  const Eigen::Vector3d before = state_.velocity_world_m_s;
  const Eigen::Matrix3d R_before = state_.T_world_body.linear();
  Eigen::Vector3d push = Eigen::Vector3d::Zero();
  if (phase_ != Phase::kFalling) {
    const double yaw_share = 1 - std::exp(-dt_s / limits_.yaw_time_s);
    yaw_rate_rad_s_ +=
        yaw_share * (limits_.yaw_rate_rad_s * cut(obeyed.turn_left) - yaw_rate_rad_s_);
    yaw_rad_ += yaw_rate_rad_s_ * dt_s;
    push = thrust(dt_s, obeyed);
    state_.T_world_body.linear() = attitudeOf(push, yaw_rad_);
  }
  const Eigen::Vector3d acceleration =
      push - kDrag_per_s * (before - wind_m_s_) - kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  state_.T_world_body.translation() += before * dt_s + 0.5 * acceleration * dt_s * dt_s;
  state_.velocity_world_m_s = before + acceleration * dt_s;
  state_.acceleration_world_m_s2 = acceleration;
  const Eigen::AngleAxisd rotation(R_before.transpose() * state_.T_world_body.linear());
  state_.angular_rate_body_rad_s = rotation.axis() * (rotation.angle() / dt_s);
  stopAtWalls();

  const double height_m = state_.T_world_body.translation().z();
  if (phase_ == Phase::kTakingOff && height_m >= limits_.take_off_m) phase_ = Phase::kFlying;
  if (height_m <= limits_.stands_m && state_.velocity_world_m_s.z() < 0) standDown();
}

}  // namespace ardrone_vslam
