// SPDX-License-Identifier: BSD-3-Clause
// tf: where the camera sits, and whether the odometry's frames are those of the tree.
#pragma once

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// The odometry's frame_id and child_frame_id are there and in the tree, with the tree's prefix
/// (`odometry_frames`). @param parameters  gets what to set
Finding checkOdometryFrames(const DoctorRecording& recording,
                            std::vector<SuggestedParameter>& parameters);

/// base -> each camera is in tf and can be (`camera_tf`).
/// @param static_transform  gets the command line of a usual mounting when there is none
Findings checkCameraTf(const DoctorRecording& recording, std::string& static_transform);

/// The frames of the images, in the order of their first one.
std::vector<std::string> cameraFrames(const DoctorRecording& recording);

}  // namespace ardrone_vslam
