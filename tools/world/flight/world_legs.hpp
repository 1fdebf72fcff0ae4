// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "world/flight/world_flight.hpp"
#include "world/flight/world_motion.hpp"

namespace ardrone_vslam {

/// From place to place, hovering between: at rest at 0, then within `sway` of the legs.
class LegsFlight : public Flight {
 public:
  /// [m, m, m, rad], as functions of time.
  struct Path {
    Legs x, y, z, yaw;
    double sway = 1;      ///< share of the gusts
    double wander_m = 0;  ///< how far it drifts to the sides, slowly
    double yaw_sway_rad = 0;
  };

  explicit LegsFlight(Path path) : path_(std::move(path)) {}

 protected:
  Eigen::Vector3d position(double t_s) const override;
  double yaw(double t_s) const override;

 private:
  Path path_;
};

LegsFlight hoverFlight(const std::optional<FlightStart>& start);
/// Out, and back flying backwards; `turns`: turns round and flies back forwards.
LegsFlight corridorFlight(bool turns);
/// Turns on the spot, slowly and quickly, its middle standing still.
LegsFlight pureYawFlight(const std::optional<FlightStart>& start);
/// Over the table and back, with a climb that is none of the table's.
LegsFlight tableFlight();

}  // namespace ardrone_vslam
