// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "ardrone_vslam/odometry_adapter.hpp"
#include "doctor/recording/doctor_recording.hpp"

namespace ardrone_vslam {

/// The odometry as the mapper would use it: bursts spread, jumps taken out.
struct AdaptedOdometry {
  std::vector<OdometryState> states;  ///< stamps ascending
  OdometryFaultCounts faults{};
  std::size_t refused = 0;  ///< messages that are not finite or out of bounds
  std::size_t refused_imu = 0;
};
AdaptedOdometry adapt(const DoctorRecording& recording, OdometryMode mode,
                      OdometryHeight height = OdometryHeight::kPose);

}  // namespace ardrone_vslam
