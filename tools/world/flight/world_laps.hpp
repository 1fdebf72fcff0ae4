// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "world/flight/world_flight.hpp"
#include "world/flight/world_motion.hpp"

namespace ardrone_vslam {

/// Counter-clockwise laps on an ellipse, no two quite alike, the nose along the path and at times
/// turned outwards to the wall.
class Laps : public Flight {
 public:
  explicit Laps(const std::optional<FlightStart>& start);

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;
  /// Where it is on the ellipse [rad].
  double phase(double t_s) const;
  /// Direction of the ellipse's tangent: that of a circle, corrected; never wraps.
  double pathYaw(double t_s) const;

 private:
  Eigen::Vector3d pathPosition(double t_s) const;

  FlightStart start_;
  double first_phase_ = 0;
  double first_rotation_ = 0;
};

/// One lap, then hovering where it began: within a few centimetres and about a degree.
class LapsThenHover : public Laps {
 public:
  static constexpr double kHoverBegin_s = 21.5;  // the lap is complete

  using Laps::Laps;

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;

 private:
  static double lapTime(double t_s);
};

/// A slow turn on the spot, then laps.
class TurnThenLaps : public Laps {
 public:
  using Laps::Laps;

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;
};

/// Laps, and after a while much faster ones with quick looks aside.
class FastLaps : public Laps {
 public:
  using Laps::Laps;

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;

 private:
  static double lapTime(double t_s);
};

/// A robot on wheels: it stays level and goes where its nose points.
class Drive : public Laps {
 public:
  Drive() : Laps(std::nullopt) {}

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;
  bool drives() const override { return true; }
};

}  // namespace ardrone_vslam
