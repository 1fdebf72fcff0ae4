// SPDX-License-Identifier: BSD-3-Clause
// Stamps: whether messages come regularly, in order, and by one clock.
#pragma once

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// Which topics there are and which are looked at (`topics`).
Finding checkTopics(const DoctorRecording& recording);

/// Rate, gaps (`image_rate`), zero, equal and backward stamps (`image_stamps`), what cannot be
/// decoded (`image_format`).
Findings checkImageStream(const DoctorRecording& recording);

/// `odometry_rate`, `odometry_stamps` and several messages with one stamp (`odometry_bursts`).
Findings checkOdometryStream(const DoctorRecording& recording);

/// Whether images and odometry are of one time and one clock: their stamps overlap and come as late
/// after the stamp (`clock`).
Finding checkClock(const DoctorRecording& recording);

/// The part of a message's age that is not the other clock's: median of reception less stamp [s].
/// @return nothing without stamps
std::optional<double> medianLatency_s(const std::vector<DoctorTime>& times);

}  // namespace ardrone_vslam
