// SPDX-License-Identifier: BSD-3-Clause
#include "world/flight/world_legs.hpp"

#include <cmath>

#include "world/scene/world_corridor.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSwayBegin_s = 3;

}  // namespace

Eigen::Vector3d LegsFlight::position(double t_s) const {
  const Eigen::Vector3d wander(wave(t_s, 0.053, 0), wave(t_s, 0.061, 1.5),
                               0.3 * wave(t_s, 0.07, 3));
  return Eigen::Vector3d(path_.x.at(t_s), path_.y.at(t_s), path_.z.at(t_s)) +
         smoothStep(t_s / kSwayBegin_s) * (path_.sway * gusts(t_s) + path_.wander_m * wander);
}

double LegsFlight::yaw(double t_s) const {
  return path_.yaw.at(t_s) + path_.yaw_sway_rad * smoothStep(t_s / kSwayBegin_s) *
                                 (wave(t_s, 0.13, 1) + 0.4 * wave(t_s, 0.29, 2));
}

LegsFlight hoverFlight(const std::optional<FlightStart>& start) {
  const FlightStart at = start.value_or(FlightStart{-1.2, 0.3, 0});
  LegsFlight::Path path{Legs(at.x_m), Legs(at.y_m), Legs(1.2), Legs(at.yaw_rad)};
  path.wander_m = 0.12;
  path.yaw_sway_rad = 0.02;
  return LegsFlight(path);
}

LegsFlight corridorFlight(bool turns) {
  constexpr double kLength_m = 30, kRamp_s = 4, kOneWay_s = 32;
  const double out_s = 2, turn_s = out_s + kOneWay_s + 1.5, back_s = turn_s + (turns ? 7.5 : 1.5);
  LegsFlight::Path path{Legs(kCorridorLength_m / 2 - kLength_m / 2), Legs(0), Legs(1.2), Legs(0)};
  path.x.move(out_s, out_s + kOneWay_s, kLength_m, kRamp_s)
      .move(back_s, back_s + kOneWay_s, -kLength_m, kRamp_s);
  if (turns) path.yaw.move(turn_s, back_s - 1.5, M_PI, 1.5);
  path.wander_m = 0.2;
  path.yaw_sway_rad = 0.05;
  return LegsFlight(path);
}

LegsFlight pureYawFlight(const std::optional<FlightStart>& start) {
  const FlightStart at = start.value_or(FlightStart{-1.2, 0.3, 0});
  LegsFlight::Path path{Legs(at.x_m), Legs(at.y_m), Legs(1.2), Legs(at.yaw_rad)};
  path.yaw.move(2, 22, 2 * M_PI, 2)
      .move(24, 34, -2 * M_PI, 1.5)
      .move(36, 39, M_PI, 0.8)
      .move(41, 44, -M_PI, 0.8);
  path.sway = 0;
  return LegsFlight(path);
}

LegsFlight tableFlight() {
  constexpr double kBefore_m = -2.2, kBeyond_m = 1.8, kRamp_s = 1.5, kClimb_m = 0.5;
  LegsFlight::Path path{Legs(kBefore_m), Legs(0), Legs(1.3), Legs(0)};
  path.x
      .move(2, 7, -kBefore_m, kRamp_s)  // and hovers above it
      .move(11, 16, kBeyond_m, kRamp_s)
      .move(18, 26, kBefore_m - kBeyond_m, kRamp_s)
      .move(36, 44, kBeyond_m - kBefore_m, kRamp_s)
      .move(50, 58, kBefore_m - kBeyond_m, kRamp_s);
  path.z.move(29, 33, kClimb_m, kRamp_s).move(46, 49, -kClimb_m, 1);
  return LegsFlight(path);
}

}  // namespace ardrone_vslam
