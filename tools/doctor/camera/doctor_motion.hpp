// SPDX-License-Identifier: BSD-3-Clause
// The images against the odometry.
#pragma once

#include <string>

#include "ardrone_vslam/time_offset.hpp"
#include "doctor/camera/doctor_extrinsics.hpp"
#include "doctor/camera/doctor_tracks.hpp"
#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_report.hpp"

namespace ardrone_vslam {

/// Whether the odometry moves, at least where the images do (`odometry_moves`).
Finding checkMoves(const DoctorRecording& recording, const Tracks& tracks,
                   const std::vector<OdometryState>& odometry);

/// Of each camera whose place tf tells.
struct CameraExtrinsics {
  std::string frame;
  Eigen::Isometry3d T_base_cam;  ///< by tf
  ExtrinsicsEstimate estimate;
  TimeOffset offset;  ///< unless the mounting is found: not known
};
std::vector<CameraExtrinsics> estimateAllExtrinsics(const DoctorRecording& recording,
                                                    const Tracks& tracks,
                                                    const std::vector<OdometryState>& odometry);

/// Whether each camera looks where tf says (`camera_direction`).
/// @param static_transform  gets the command line that corrects it
Findings checkDirections(const std::vector<CameraExtrinsics>& cameras,
                         const std::string& base_frame, std::string& static_transform);

/// Whether images and odometry move at the same time (`image_time_offset`).
Finding checkTimeOffset(const std::vector<CameraExtrinsics>& cameras,
                        std::vector<SuggestedParameter>& parameters);

}  // namespace ardrone_vslam
