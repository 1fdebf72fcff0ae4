// SPDX-License-Identifier: BSD-3-Clause
// Where the odometry's z comes from.
#pragma once

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// Heights in whole metres (`height_metres`); heights above what is below, which a table makes
/// step, against the integrated vertical velocity (`height_ground`).
Findings checkHeight(const DoctorRecording& recording, std::vector<SuggestedParameter>& parameters);

}  // namespace ardrone_vslam
