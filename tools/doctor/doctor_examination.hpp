// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include "doctor/doctor_configuration.hpp"
#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// All checks, one after the other.
/// @param progress  told how many images have been tracked; may be empty
/// @param in_force  what it answers is no warning; not known: the shipped file for what the
/// recording looks like is named
DoctorReport examine(const DoctorRecording& recording,
                     const std::function<void(std::size_t done)>& progress,
                     const DoctorConfiguration& in_force = {});

}  // namespace ardrone_vslam
