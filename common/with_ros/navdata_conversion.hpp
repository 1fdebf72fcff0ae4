// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/Twist.h>
#include <sensor_msgs/Imu.h>

#include "ardrone_vslam/drone_observer.hpp"
#include "ardrone_vslam/height_input.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

/// The frame of the package's own observer, unless odom_frame names another: the driver's `odom`
/// has another integration.
constexpr const char* kObserverFrame = "observer_odom";

/// The velocities are the optical flow's; the message's upward one, which many firmwares leave
/// zero, is not used. Values out of bounds are DroneObserver's to refuse.
Checked<NavdataReading> toNavdataReading(const Navdata& message);
/// A vertical reading: the drone has turned its sonar's range upright itself. Zero, which it sends
/// on the ground, is out of its bounds.
Checked<RangeReading> toHeightReading(const Navdata& message);
Checked<DroneImu> toDroneImu(const sensor_msgs::Imu& message);
/// @param received_ns  commands have no stamp
DroneCommandReading toDroneCommand(const geometry_msgs::Twist& message, std::int64_t received_ns);

}  // namespace ardrone_vslam
