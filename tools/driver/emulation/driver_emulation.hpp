// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "driver/driver_faults.hpp"
#include "driver/drone_packet.hpp"

namespace ardrone_vslam {

struct DriverFrames {
  std::string odom;
  std::string base;
  std::string front;
  std::string bottom;
};

/// As the driver resolves them. @param tf_prefix  without slashes around it; may be empty
DriverFrames driverFrames(const std::string& tf_prefix);

/// What the driver publishes of one packet.
struct DriverMessages {
  Navdata navdata;
  sensor_msgs::Imu imu;
  geometry_msgs::Vector3Stamped mag;
  nav_msgs::Odometry odometry;
  geometry_msgs::TransformStamped T_odom_base;
};

/// What ardrone_autonomy 1.4.1 makes of the drone's packets: units, frames, stamps, integration.
/// Without faults its odometry is the integral of its twist with its quaternion, in x and y from
/// where the driver was started, in z from the height there.
class DriverEmulation {
 public:
  DriverEmulation(DriverFaults faults, const std::string& tf_prefix);

  /// @param stamp_ns  of reception by the host; it may repeat
  DriverMessages receive(const DronePacket& packet, std::int64_t stamp_ns);
  /// Base to both cameras; the driver sends it at 10 Hz.
  std::vector<geometry_msgs::TransformStamped> cameraTransforms(std::int64_t stamp_ns) const;
  /// The driver is started again: its odometry begins anew.
  void restart() { last_stamp_ns_.reset(); }

  const DriverFrames& frames() const { return frames_; }

 private:
  bool has(DriverFault fault) const { return faults_.count(fault) > 0; }
  void integrate(const DronePacket& packet, std::int64_t stamp_ns);
  double reportedHeight_m(const Navdata& navdata) const;

  DriverFaults faults_;
  DriverFrames frames_;
  std::optional<std::int64_t> last_stamp_ns_;  // nothing: no packet since the start
  Eigen::Vector3d position_odom_m_ = Eigen::Vector3d::Zero();
};

}  // namespace ardrone_vslam
