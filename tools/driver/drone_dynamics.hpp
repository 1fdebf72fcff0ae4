// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "world/flight/world_flight.hpp"

namespace ardrone_vslam {

/// What a controller asks for, each within +-1 as the driver's cmd_vel; what is beyond is cut.
struct DroneCommand {
  double forward = 0;
  double left = 0;
  double up = 0;
  double turn_left = 0;
  /// Without a command it stops; false: it only levels out.
  bool auto_hover = true;

  bool isZero() const { return forward == 0 && left == 0 && up == 0 && turn_left == 0; }
};

/// How the AR.Drone's own controller answers; the defaults are its usual limits.
struct DroneLimits {
  double tilt_rad = 0.21;        ///< at a command of 1
  double climb_m_s = 0.7;        ///< likewise
  double yaw_rate_rad_s = 1.75;  ///< likewise
  double tilt_time_s = 0.12;     ///< time constant of roll and pitch, twice over
  double climb_time_s = 0.25;    ///< of the vertical speed, twice over
  double yaw_time_s = 0.15;      ///< of the turn rate
  double brake_per_s =
      1.2;  ///< without a command it tilts against its speed: deceleration per speed
  double take_off_m = 1.0;  ///< height at which it hovers after take-off
  double stands_m = 0;      ///< height of its middle on the floor
};

/// A drone that flies as it is told: the same state as a Flight's, advanced in small steps. Thrust
/// is along the body's z, air brakes by 0.3/s. It hovers when no command is given, stands on the
/// floor until takeOff and from the end of land on. Walls stop it; furniture is none.
class DroneDynamics {
 public:
  enum class Phase { kLanded, kTakingOff, kFlying, kLanding, kFalling };

  /// On the floor.
  explicit DroneDynamics(const FlightStart& start = {}, const DroneLimits& limits = {});

  /// Ignored unless landed, or unless in the air.
  void takeOff();
  void land();
  /// It falls. Ignored when landed.
  void cutMotors();
  /// Where its middle can be, above the floor; without, everywhere.
  void keepWithin(const Eigen::AlignedBox3d& space);
  /// Of the air [m/s, world]; the drone holds its speed against it only in part.
  void setWind(const Eigen::Vector3d& wind_m_s) { wind_m_s_ = wind_m_s; }
  /// Steps of at most 2 ms; equal steps give equal results. @pre seconds >= 0
  void advance(double seconds, const DroneCommand& command);

  /// T_world_body's z is the height above the floor z = 0.
  const FlightState& state() const { return state_; }
  Phase phase() const { return phase_; }

 private:
  /// A value that follows what is wanted through two equal lags, so that its rate never leaps.
  struct Follower {
    double value = 0;
    double between = 0;
    void step(double wanted, double time_s, double dt_s);
  };

  void step(double dt_s, const DroneCommand& command);
  double wantedClimb(const DroneCommand& command) const;
  Eigen::Vector3d thrust(double dt_s, const DroneCommand& command);
  void stopAtWalls();
  void standDown();

  DroneLimits limits_;
  Eigen::AlignedBox3d space_;  // empty: unbounded
  Eigen::Vector3d wind_m_s_ = Eigen::Vector3d::Zero();
  Phase phase_ = Phase::kLanded;
  FlightState state_;
  double yaw_rad_;
  double yaw_rate_rad_s_ = 0;
  Follower tilt_forward_;  // tangents of the angles by which thrust leans, in the heading's frame
  Follower tilt_left_;
  Follower climb_;
};

}  // namespace ardrone_vslam
