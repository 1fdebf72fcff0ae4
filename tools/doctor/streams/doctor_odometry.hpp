// SPDX-License-Identifier: BSD-3-Clause
// What the odometry's numbers tell of its source.
#pragma once

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// Numbers that are none or cannot be (`odometry_values`), positions that jump or begin anew
/// (`odometry_jumps`), that are not in metres (`odometry_unit`).
Findings checkOdometryValues(const DoctorRecording& recording);

/// Covariances that are zero or mean "unknown" (`odometry_covariance`), a turn rate that is not
/// filled (`odometry_turn_rate`).
Findings checkOdometryFields(const DoctorRecording& recording,
                             std::vector<SuggestedParameter>& parameters);

/// Whether the positions are the integral of the twist turned by the orientation, or by the
/// mirrored yaw as ardrone_autonomy has it, or not at all (`odometry_yaw`).
Finding checkOdometryYaw(const DoctorRecording& recording,
                         std::vector<SuggestedParameter>& parameters);

}  // namespace ardrone_vslam
