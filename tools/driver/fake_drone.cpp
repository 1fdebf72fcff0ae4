// SPDX-License-Identifier: BSD-3-Clause
#include "driver/fake_drone.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "input_checks/checked.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint64_t kWindStream = 'W';
constexpr double kWindTime_s = 10;
constexpr double kStands_m = 0.1;   // its middle above the floor it stands on
constexpr double kRadius_m = 0.35;  // hull included

/// Where the drone's middle can be.
Eigen::AlignedBox3d spaceIn(const World::Extent& extent) {
  const Eigen::Vector3d half(extent.size_m.x() / 2 - kRadius_m, extent.size_m.y() / 2 - kRadius_m,
                             0);
  Eigen::AlignedBox3d space(extent.middle_m - half, extent.middle_m + half);
  space.max().z() = extent.size_m.z() - kRadius_m;
  return space;
}

/// Where the flight begins that suits such a world: free of furniture.
FlightStart freePlace(const World::Extent& extent) {
  const bool is_long = extent.size_m.x() > 3 * extent.size_m.y();
  const Eigen::Isometry3d pose = makeFlight(is_long ? "corridor" : "laps", {})->pose(0);
  const Eigen::Matrix3d R = pose.linear();
  return {pose.translation().x(), pose.translation().y(), std::atan2(R(1, 0), R(0, 0))};
}

FlightStart startIn(const World& world, const std::optional<FlightStart>& asked) {
  if (!asked) return freePlace(world.extent());
  const Eigen::AlignedBox3d space = spaceIn(world.extent());
  if (!std::isfinite(asked->yaw_rad) ||
      !space.contains(Eigen::Vector3d(asked->x_m, asked->y_m, 0))) {
    throw std::invalid_argument(text("start: it must be inside the world and ", kRadius_m,
                                     " m from its walls: X within ", space.min().x(), " and ",
                                     space.max().x(), ", Y within ", space.min().y(), " and ",
                                     space.max().y(), " m"));
  }
  return *asked;
}

DroneLimits standing() {
  DroneLimits limits;
  limits.stands_m = kStands_m;
  return limits;
}

bool isFinite(const DroneCommand& c) {
  return std::isfinite(c.forward) && std::isfinite(c.left) && std::isfinite(c.up) &&
         std::isfinite(c.turn_left);
}

}  // namespace

FakeDrone::FakeDrone(World world, const FakeDroneOptions& options)
    : world_(std::move(world)),
      options_(options),
      flight_(options.autopilot.empty() ? nullptr : makeFlight(options.autopilot, options.start)),
      dynamics_(flight_ ? FlightStart() : startIn(world_, options.start), standing()),
      sensors_(options.profile, options.seed),
      gusts_(options.seed, kWindStream),
      start_m_((flight_ ? flight_->pose(0) : dynamics_.state().T_world_body).translation()) {
  start_m_.z() = 0;
  dynamics_.keepWithin(spaceIn(world_.extent()));
}

std::string FakeDrone::refusal(const std::string& what) const {
  return what + " is ignored: the autopilot flies " + options_.autopilot +
         "; start with autopilot none to fly it by hand";
}

std::string FakeDrone::takeOff() {
  if (flight_) return refusal("takeoff");
  if (emergency_) return "takeoff is ignored: the drone is in emergency; send ardrone/reset first";
  if (dynamics_.phase() != DroneDynamics::Phase::kLanded)
    return "takeoff is ignored: the drone is not on the floor";
  command_ = {};
  dynamics_.takeOff();
  return {};
}

std::string FakeDrone::land() {
  if (flight_) return refusal("land");
  dynamics_.land();
  return {};
}

std::string FakeDrone::reset() {
  if (flight_) return refusal("reset");
  const bool was_landed = dynamics_.phase() == DroneDynamics::Phase::kLanded;
  emergency_ = !emergency_ && !was_landed;
  if (emergency_) dynamics_.cutMotors();
  return {};
}

std::string FakeDrone::command(const DroneCommand& command) {
  if (flight_) return refusal("cmd_vel");
  if (!isFinite(command)) {
    command_ = {};
    return "cmd_vel has a number that is not finite: the drone hovers instead";
  }
  command_ = command;
  return {};
}

/// Ornstein-Uhlenbeck, from calm air on.
void FakeDrone::blow() {
  const double keep = std::exp(-kPacketStep_s / kWindTime_s);
  const double noise_m_s = options_.wind_m_s * std::sqrt(1 - keep * keep);
  wind_m_s_.head<2>() = keep * wind_m_s_.head<2>() + noise_m_s * gusts_.normal3().head<2>();
  dynamics_.setWind(wind_m_s_);
}

DronePacket::State FakeDrone::reportedState(const DronePacket& packet) const {
  using State = DronePacket::State;
  if (flight_) return packet.state;
  if (emergency_) return State::kUnknown;
  switch (dynamics_.phase()) {
    case DroneDynamics::Phase::kLanded:
      return State::kLanded;
    case DroneDynamics::Phase::kTakingOff:
      return State::kTakingOff;
    case DroneDynamics::Phase::kLanding:
      return State::kLanding;
    default:
      return command_.isZero() && command_.auto_hover ? State::kHovering : State::kFlying;
  }
}

DroneMoment FakeDrone::advance() {
  DroneMoment moment;
  if (!flight_) {
    blow();
    dynamics_.advance(kPacketStep_s, command_);
  }
  if (!flight_ || begun_) ++steps_;
  moment.t_s = static_cast<double>(steps_) * kPacketStep_s;
  moment.state = flight_ ? flight_->state(moment.t_s) : dynamics_.state();
  moment.packet =
      sensors_.measure(moment.state, world_.rangeBelow_m(moment.state.T_world_body, moment.t_s));
  moment.packet.state = reportedState(moment.packet);
  return moment;
}

}  // namespace ardrone_vslam
