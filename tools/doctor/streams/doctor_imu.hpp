// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

constexpr double kGravity_m_s2 = 9.81;

/// What is wrong with an accelerometer's readings; empty for gravity and what a flight adds to it.
/// @param forces_m_s2  their sizes
std::string forceFault(std::vector<double> forces_m_s2, double unit_m_s2, const char* unit);

/// Numbers that are none, all zero or in another unit (`imu_values`).
/// @param refused  how many the odometry did not take
Finding checkImuValues(const DoctorRecording& recording, std::size_t refused);

/// Turn rates against the turning of navdata's attitude (`imu_turn_rate`).
Finding checkImuTurnRate(const DoctorRecording& recording);

}  // namespace ardrone_vslam
