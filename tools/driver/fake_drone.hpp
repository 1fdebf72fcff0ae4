// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "driver/drone_dynamics.hpp"
#include "driver/drone_packet.hpp"
#include "driver/drone_sensors.hpp"
#include "simulation/random_source.hpp"
#include "world/flight/world_flight.hpp"
#include "world/world.hpp"

namespace ardrone_vslam {

struct FakeDroneOptions {
  std::string autopilot;  ///< the flight that it flies by itself; empty: it obeys commands
  std::optional<FlightStart> start;  ///< nothing: where the flight, or the world's laps, begin
  OdometryProfile profile;           ///< how its measurements drift
  double wind_m_s = 0.2;             ///< sigma of the air's speed along x and y
  std::uint64_t seed = 0;
};

/// What a drone does and measures in one period of its packets.
struct DroneMoment {
  double t_s;  ///< the world's time: since the begin of the flight with an autopilot
  FlightState state;
  DronePacket packet;
};

/// An AR.Drone in a world, packet by packet: on the floor until it is told to take off, or flying a
/// named flight by itself. Equal calls give equal answers.
class FakeDrone {
 public:
  /// @throws std::invalid_argument for an unknown flight, and a start in a wall or outside
  FakeDrone(World world, const FakeDroneOptions& options);

  /// Each answers why it is not obeyed; empty when it is.
  std::string takeOff();
  std::string land();
  /// Cuts the motors in flight (emergency) and, called again, allows to take off. On the floor and
  /// without an emergency it does nothing.
  std::string reset();
  /// Holds until the next one. Parts beyond +-1 are cut; what is not finite is answered by
  /// hovering.
  std::string command(const DroneCommand& command);
  /// The autopilot hovers where its flight begins until this.
  void beginFlight() { begun_ = true; }

  /// The next 1 / kPacketRate_hz.
  DroneMoment advance();

  const World& world() const { return world_; }
  /// Where it was switched on: the origin of its odometry is above or below it, on the floor.
  const Eigen::Vector3d& start_m() const { return start_m_; }

 private:
  DronePacket::State reportedState(const DronePacket& packet) const;
  void blow();
  std::string refusal(const std::string& what) const;

  World world_;
  FakeDroneOptions options_;
  std::unique_ptr<const Flight> flight_;  // nothing: commands
  DroneDynamics dynamics_;
  DroneSensors sensors_;
  RandomSource gusts_;
  Eigen::Vector3d wind_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d start_m_;
  DroneCommand command_;
  bool emergency_ = false;
  bool begun_ = false;
  std::int64_t steps_ = 0;  // of the world's time
};

}  // namespace ardrone_vslam
