// SPDX-License-Identifier: BSD-3-Clause
// The images against the odometry.
#pragma once

#include <string>

#include "doctor_mounting.hpp"
#include "doctor_recording.hpp"
#include "doctor_report.hpp"
#include "doctor_tracks.hpp"

namespace ardrone_vslam {

/// Whether the odometry moves, at least where the images do (`odometry_moves`).
Finding checkMoves(const DoctorRecording& recording, const Tracks& tracks,
                   const std::vector<ObserverState>& odometry);

/// Whether each camera looks where tf says (`camera_direction`).
/// @param static_transform  gets the command line that corrects it
Findings checkDirections(const DoctorRecording& recording, const Tracks& tracks,
                         const std::vector<ObserverState>& odometry, double offset_s,
                         std::string& static_transform);

}  // namespace ardrone_vslam
