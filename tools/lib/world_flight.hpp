// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ardrone_vslam {

/// Where a flight begins, hovering at rest: metres and radians in the world, yaw from its x axis.
struct FlightStart {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// How a quadrocopter moves. Each flight gives position and heading; roll and pitch follow from the
/// accelerations and the drag, as the rotors' thrust is the only thing that moves it.
class Flight {
 public:
  virtual ~Flight() = default;

  /// T_world_body, t_s seconds after the beginning; smooth, at rest at 0.
  Eigen::Isometry3d pose(double t_s) const;

 protected:
  virtual Eigen::Vector3d position(double t_s) const = 0;  // m, world
  virtual double yaw(double t_s) const = 0;                // rad, not wrapped
};

/// Names that makeFlight knows.
std::vector<std::string> flightNames();

/// When a flight that ends hovering begins to; nothing for the others.
std::optional<double> hoverBegin_s(const std::string& flight);

/// @param start  nothing: the flight's own
/// @throws std::invalid_argument for an unknown name (listing the known ones) and for a start
/// outside the room or within 0.5 m of its walls
std::unique_ptr<Flight> makeFlight(const std::string& name,
                                   const std::optional<FlightStart>& start);

}  // namespace ardrone_vslam
