// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>

#include "ardrone_vslam/imu_odometry.hpp"
#include "input_checks/checked.hpp"

namespace ardrone_vslam {

/// The attitude of an IMU that tells one: gyroscope and accelerometer alone are a fault.
/// @param R_base_imu  how the IMU is mounted
Checked<ImuAttitude> toImuAttitude(const sensor_msgs::Imu& message,
                                   const Eigen::Quaterniond& R_base_imu);

}  // namespace ardrone_vslam
