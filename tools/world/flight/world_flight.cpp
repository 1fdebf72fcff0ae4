// SPDX-License-Identifier: BSD-3-Clause
#include "world/flight/world_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "world/flight/world_laps.hpp"
#include "world/flight/world_legs.hpp"
#include "world/scene/world_room.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kWallMargin_m = 0.5;

Eigen::Vector3d rotationFrom(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::AngleAxisd turn(a.transpose() * b);
  return turn.axis() * turn.angle();
}

void checkStart(const FlightStart& start) {
  const bool inside = std::abs(start.x_m) <= kRoomLength_m / 2 - kWallMargin_m &&
                      std::abs(start.y_m) <= kRoomWidth_m / 2 - kWallMargin_m &&
                      std::isfinite(start.yaw_rad);
  if (!inside) {
    throw std::invalid_argument(
        "the start must be at least 0.5 m from the walls of the room: X within -3.5 and 3.5, Y "
        "within -2.5 and 2.5 m");
  }
}

}  // namespace

Eigen::Matrix3d attitudeOf(const Eigen::Vector3d& thrust_world, double yaw_rad) {
  const Eigen::Vector3d forward(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  const Eigen::Vector3d z = thrust_world.normalized();
  const Eigen::Vector3d y = z.cross(forward).normalized();
  Eigen::Matrix3d R_world_body;
  R_world_body << y.cross(z), y, z;
  return R_world_body;
}

Eigen::Isometry3d Flight::pose(double t_s) const {
  constexpr double kStep_s = 0.01;  // the error of the acceleration is about 1e-5 m/s^2
  const Eigen::Vector3d before = position(t_s - kStep_s), now = position(t_s),
                        after = position(t_s + kStep_s);
  const Eigen::Vector3d velocity = (after - before) / (2 * kStep_s);
  const Eigen::Vector3d acceleration = (after - 2 * now + before) / (kStep_s * kStep_s);
  Eigen::Vector3d thrust = kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  if (!drives()) thrust += acceleration + kDrag_per_s * velocity;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  T_world_body.linear() = attitudeOf(thrust, yaw(t_s));
  T_world_body.translation() = now;
  return T_world_body;
}

FlightState Flight::state(double t_s) const {
  constexpr double kStep_s = 0.01;
  constexpr std::array<double, 3> kFirst = {3.0 / 4, -3.0 / 20, 1.0 / 60};
  constexpr std::array<double, 3> kSecond = {3.0 / 2, -3.0 / 20, 1.0 / 90};
  const Eigen::Vector3d now = position(t_s);
  FlightState state;
  state.T_world_body = pose(t_s);
  for (std::size_t i = 0; i < kFirst.size(); ++i) {
    const double step_s = kStep_s * static_cast<double>(i + 1);
    const Eigen::Vector3d before = position(t_s - step_s), after = position(t_s + step_s);
    state.velocity_world_m_s += kFirst[i] / kStep_s * (after - before);
    state.acceleration_world_m_s2 += kSecond[i] / (kStep_s * kStep_s) * (after - 2 * now + before);
    // In the body of now, so that opposite turns about it add up without a common rotation.
    const Eigen::Matrix3d& R_world_body = state.T_world_body.linear();
    state.angular_rate_body_rad_s += kFirst[i] / kStep_s *
                                     (rotationFrom(R_world_body, pose(t_s + step_s).linear()) -
                                      rotationFrom(R_world_body, pose(t_s - step_s).linear()));
  }
  return state;
}

const std::vector<FlightInfo>& flights() {
  static const std::vector<FlightInfo> all = {
      {"laps", "laps around the room, now and then looking at the wall", "room", "steady"},
      {"laps_then_hover", "one lap, then hovering where it began", "room", "steady",
       LapsThenHover::kHoverBegin_s + 60},
      {"mapping_turn", "a slow turn by 360 degrees on the spot, then laps", "room", "steady", 82},
      {"hover", "holds its place as well as a drone does", "furnished", "steady"},
      {"corridor", "30 m down a corridor, and back flying backwards", "corridor", "steady", 71},
      {"corridor_turn", "30 m down a corridor, turns round, and back", "corridor", "steady", 77},
      {"pure_yaw", "turns on the spot, slowly and quickly, its middle never moving", "furnished",
       "steady", 46},
      {"fast_blur", "laps, from 20 s on at 2 m/s with quick looks aside; motion blur", "furnished",
       "steady", 60, 0.016, 0.025},
      {"dark", "laps; the light fades at 20 s, for 12 s, and comes back weaker", "furnished",
       "fading"},
      {"table", "over a table and back, with a climb that is none of the table's", "furnished",
       "steady", 60},
      {"drive", "a robot on wheels drives laps, its camera 0.3 m above the floor", "furnished",
       "steady"},
      {"moving_objects", "laps among boxes that move, under a lamp that does", "moving", "moving"},
  };
  return all;
}

const FlightInfo& flightInfo(const std::string& name) {
  std::string known;
  for (const auto& flight : flights()) {
    if (flight.name == name) return flight;
    known += (known.empty() ? "" : ", ") + flight.name;
  }
  throw std::invalid_argument("there is no flight '" + name + "'; known are " + known);
}

std::optional<double> hoverBegin_s(const std::string& flight) {
  if (flight != "laps_then_hover") return std::nullopt;
  return LapsThenHover::kHoverBegin_s;
}

std::unique_ptr<Flight> makeFlight(const std::string& name,
                                   const std::optional<FlightStart>& start) {
  flightInfo(name);
  const bool is_corridor = name == "corridor" || name == "corridor_turn";
  const bool is_fixed = is_corridor || name == "table" || name == "drive";
  if (start && is_fixed)
    throw std::invalid_argument("the flight " + name + " has a start of its own: leave start out");
  if (start) checkStart(*start);
  if (name == "laps_then_hover") return std::make_unique<LapsThenHover>(start);
  if (name == "mapping_turn") return std::make_unique<TurnThenLaps>(start);
  if (name == "drive") return std::make_unique<Drive>();
  if (name == "fast_blur") return std::make_unique<FastLaps>(start);
  if (name == "hover") return std::make_unique<LegsFlight>(hoverFlight(start));
  if (name == "pure_yaw") return std::make_unique<LegsFlight>(pureYawFlight(start));
  if (name == "table") return std::make_unique<LegsFlight>(tableFlight());
  if (is_corridor) return std::make_unique<LegsFlight>(corridorFlight(name == "corridor_turn"));
  return std::make_unique<Laps>(start);
}

}  // namespace ardrone_vslam
