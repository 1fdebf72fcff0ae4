// SPDX-License-Identifier: BSD-3-Clause
// The AR.Drone's navdata and IMU, of which odometry_mode navdata makes an observer.
#pragma once

#include "doctor/recording/doctor_report.hpp"
#include "doctor/streams/adapted_odometry.hpp"

namespace ardrone_vslam {

/// What the package's own observer makes of them, in the order in which they were received.
AdaptedOdometry observeNavdata(const DoctorRecording& recording);

/// `navdata_rate`, `_stamps`, `_bursts` and `imu_` the same; nothing without navdata. Faults only
/// where there is no odometry.
Findings checkNavdataStreams(const DoctorRecording& recording);

/// Numbers that are none, all zero or of another unit: `navdata_values`, `navdata_height`,
/// `navdata_velocity`, `imu_values`; turn rates against the attitude's turning: `imu_turn_rate`.
Findings checkNavdataValues(const DoctorRecording& recording);

}  // namespace ardrone_vslam
