// SPDX-License-Identifier: BSD-3-Clause
#include "world/flight/world_laps.hpp"

#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr double kRadiusX_m = 2.0;
constexpr double kRadiusY_m = 1.5;
constexpr double kLap_s = 17;
constexpr double kEntry_s = 5;  // from the start to the ellipse at full speed
constexpr double kStartHeight_m = 1.2;
constexpr double kLook_s = 11;
constexpr double kLookOutwards_rad = 45 * M_PI / 180;
constexpr double kBrake_s = 4;      // of LapsThenHover
constexpr double kRotation_s = 22;  // of TurnThenLaps
constexpr double kRotationRamp_s = 2;
constexpr double kFastFrom_s = 20;  // of FastLaps
constexpr double kFastRamp_s = 4;
constexpr double kDriveHeight_m = 0.3;
constexpr double kFaster = 1.5;  // laps a lap's time more

double wrapAngle(double angle_rad) {
  return std::remainder(angle_rad, 2 * M_PI);
}

}  // namespace

Laps::Laps(const std::optional<FlightStart>& start) {
  start_ = start.value_or(FlightStart{kRadiusX_m, 0, M_PI / 2});
  first_phase_ = std::atan2(start_.y_m / kRadiusY_m, start_.x_m / kRadiusX_m);
  first_rotation_ = wrapAngle(start_.yaw_rad - pathYaw(0));
}

Eigen::Vector3d Laps::position(double t_s) const {
  const double blend = smoothStep(t_s / kEntry_s);
  const Eigen::Vector3d start(start_.x_m, start_.y_m, kStartHeight_m);
  return start + blend * (pathPosition(t_s) - start);
}

double Laps::yaw(double t_s) const {
  const double blend = smoothStep(t_s / kEntry_s);
  const double outwards = kLookOutwards_rad * (0.5 - 0.5 * std::cos(2 * M_PI * t_s / kLook_s));
  return pathYaw(t_s) - blend * outwards + (1 - blend) * first_rotation_;
}

double Laps::phase(double t_s) const {
  return first_phase_ + 2 * M_PI * kEntry_s / kLap_s * smoothStepIntegral(t_s / kEntry_s);
}

Eigen::Vector3d Laps::pathPosition(double t_s) const {
  const double stretch = 1 + 0.06 * wave(t_s, 0.021, 0.4);
  const double height = 1.25 + 0.2 * wave(t_s, 0.047, 1.1);
  return Eigen::Vector3d(stretch * kRadiusX_m * std::cos(phase(t_s)),
                         stretch * kRadiusY_m * std::sin(phase(t_s)), height) +
         gusts(t_s);
}

double Laps::pathYaw(double t_s) const {
  const double c = std::cos(phase(t_s)), s = std::sin(phase(t_s));
  return phase(t_s) + M_PI / 2 +
         std::atan2((kRadiusX_m - kRadiusY_m) * s * c, kRadiusX_m * s * s + kRadiusY_m * c * c);
}

Eigen::Vector3d LapsThenHover::position(double t_s) const {
  return Laps::position(lapTime(t_s)) + gusts(t_s) - gusts(lapTime(t_s));
}

double LapsThenHover::yaw(double t_s) const {
  constexpr double kSway_rad = 0.02;
  return Laps::yaw(lapTime(t_s)) + kSway_rad * (wave(t_s, 0.19, 1) - wave(lapTime(t_s), 0.19, 1));
}

/// Runs on as t_s does, and stops at the end of the lap.
double LapsThenHover::lapTime(double t_s) {
  const double braked_s = t_s - (kHoverBegin_s - kBrake_s);
  return t_s - kBrake_s * smoothStepIntegral(braked_s / kBrake_s);
}

Eigen::Vector3d TurnThenLaps::position(double t_s) const {
  const double swaying = smoothStep(t_s / kRotationRamp_s) -
                         smoothStep((t_s - kRotation_s + kRotationRamp_s) / kRotationRamp_s);
  return Laps::position(t_s - kRotation_s) + swaying * gusts(t_s);
}

double TurnThenLaps::yaw(double t_s) const {
  return Laps::yaw(t_s - kRotation_s) +
         Legs(0).move(0, kRotation_s, 2 * M_PI, kRotationRamp_s).at(t_s);
}

Eigen::Vector3d FastLaps::position(double t_s) const {
  return Laps::position(lapTime(t_s)) + gusts(t_s) - gusts(lapTime(t_s));
}

double FastLaps::yaw(double t_s) const {
  constexpr double kLookAside_rad = 0.5;
  return Laps::yaw(lapTime(t_s)) +
         kLookAside_rad * smoothStep((t_s - kFastFrom_s) / kFastRamp_s) * wave(t_s, 0.5, 0);
}

/// Runs on as t_s does, and faster from kFastFrom_s on.
double FastLaps::lapTime(double t_s) {
  return t_s + kFaster * kFastRamp_s * smoothStepIntegral((t_s - kFastFrom_s) / kFastRamp_s);
}

Eigen::Vector3d Drive::position(double t_s) const {
  return {kRadiusX_m * std::cos(phase(t_s)), kRadiusY_m * std::sin(phase(t_s)), kDriveHeight_m};
}

double Drive::yaw(double t_s) const {
  return pathYaw(t_s);
}

}  // namespace ardrone_vslam
