// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// All checks, one after the other.
/// @param progress  told how many images have been tracked; may be empty
DoctorReport examine(const DoctorRecording& recording,
                     const std::function<void(std::size_t done)>& progress);

}  // namespace ardrone_vslam
