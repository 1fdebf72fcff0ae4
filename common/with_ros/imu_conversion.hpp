// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>

#include "ardrone_vslam/imu_odometry.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

/// Of what ImuOdometry counts as tilted.
constexpr const char* kTiltedImuFault =
    "what it says is up is more than 60 degrees off the odometry's: the orientation must be in a "
    "world whose z points up (REP 103; not north-east-down), and tf must say how the IMU is "
    "mounted";

/// The attitude of an IMU that tells one: gyroscope and accelerometer alone are a fault.
/// @param R_base_imu  how the IMU is mounted
Checked<ImuAttitude> toImuAttitude(const sensor_msgs::Imu& message,
                                   const Eigen::Quaterniond& R_base_imu);

}  // namespace ardrone_vslam
