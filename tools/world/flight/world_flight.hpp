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

constexpr double kGravity_m_s2 = 9.81;
constexpr double kDrag_per_s = 0.3;  ///< deceleration per speed, by the air

/// R_world_body of a drone whose rotors push along this thrust and whose nose points to the yaw.
Eigen::Matrix3d attitudeOf(const Eigen::Vector3d& thrust_world, double yaw_rad);

/// What a drone does at one moment; body is its middle, x forward, y left, z up.
struct FlightState {
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_world_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_world_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_rate_body_rad_s = Eigen::Vector3d::Zero();  ///< what a gyroscope measures

  /// What an accelerometer in the middle measures: kGravity_m_s2 along z at rest.
  Eigen::Vector3d specificForce_body_m_s2() const {
    const Eigen::Vector3d gravity(0, 0, -kGravity_m_s2);
    return T_world_body.linear().transpose() * (acceleration_world_m_s2 - gravity);
  }
};

/// How a quadrocopter moves. Each flight gives position and heading; roll and pitch follow from the
/// accelerations and the drag, as the rotors' thrust is the only thing that moves it. What drives
/// stays level.
class Flight {
 public:
  virtual ~Flight() = default;

  /// T_world_body, t_s seconds after the beginning; smooth, at rest at 0.
  Eigen::Isometry3d pose(double t_s) const;
  /// The pose with its derivatives, by differences of sixth order: specific force and turn rate,
  /// integrated for ten seconds, meet the truth within 3 mm, 1 mm/s and 1e-4 rad.
  FlightState state(double t_s) const;

 protected:
  virtual Eigen::Vector3d position(double t_s) const = 0;  // m, world
  virtual double yaw(double t_s) const = 0;                // rad, not wrapped
  virtual bool drives() const { return false; }
};

/// What make_world offers.
struct FlightInfo {
  std::string name;
  std::string summary;     ///< one line
  std::string world;       ///< where it takes place: a name that makeWorld knows
  std::string light;       ///< a name of lightNames()
  double duration_s = 60;  ///< of the whole of it
  double shutter_s = 0;    ///< of the camera, unless it is told otherwise
  double readout_s = 0;    ///< likewise
};

/// All flights, in the order in which they are listed.
const std::vector<FlightInfo>& flights();
/// @throws std::invalid_argument for an unknown name, listing the known ones
const FlightInfo& flightInfo(const std::string& name);

/// When a flight that ends hovering begins to; nothing for the others.
std::optional<double> hoverBegin_s(const std::string& flight);

/// @param start  nothing: the flight's own
/// @throws std::invalid_argument for an unknown name (listing the known ones), for a start
/// outside the room or within 0.5 m of its walls, and for a flight whose start cannot be chosen
std::unique_ptr<Flight> makeFlight(const std::string& name,
                                   const std::optional<FlightStart>& start);

}  // namespace ardrone_vslam
