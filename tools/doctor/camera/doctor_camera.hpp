// SPDX-License-Identifier: BSD-3-Clause
// The calibration, against the images and against what can be.
#pragma once

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// Every image needs a camera_info with its stamp (`camera_info`).
Finding checkPairing(const DoctorRecording& recording);

/// What the tracker refuses, another size than the images', a principal point that is not near the
/// middle as K was made at another size (`calibration`; a warning where rescale_calibration helps),
/// a lens model that folds back within the image (`lens`).
Findings checkCalibrations(const DoctorRecording& recording);

/// Whether it may be right for its size: a principal point near the middle.
bool isPlausible(const CameraIntrinsics& camera);

/// Whether it can be used by rescale_calibration only.
bool needsRescaling(const DoctorCalibration& calibration);

/// As the checks take it: rescaled where it needs to be.
const CameraIntrinsics& usedCamera(const DoctorCalibration& calibration);

/// Whether frame, size or calibration change in the recording (`camera_switch`).
Finding checkCameraSwitch(const DoctorRecording& recording);

/// The calibration of an image: that of its stamp, else the only one there is.
/// @return index into the recording's; nothing when there is none, or several and none fits
std::optional<std::size_t> calibrationOf(const DoctorRecording& recording, std::size_t image);

}  // namespace ardrone_vslam
