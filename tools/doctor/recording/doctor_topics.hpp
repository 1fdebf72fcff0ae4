// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "doctor/recording/doctor_recording.hpp"

namespace ardrone_vslam {

/// Topics that the user named; empty: found by type.
struct DoctorTopicNames {
  std::string image;
  std::string camera_info;
  std::string odometry;
  std::string navdata;
  std::string imu;
};

/// Sets the recording's topics, `choices` and `replay_options` by its `topics`. Of several that fit
/// the one with the most messages is taken (before a system is listened to all have none), of these
/// the shortest name, so that doctor has something to look at where replay asks.
/// @throws std::runtime_error when a named topic is not there or of another type
void chooseTopics(const DoctorTopicNames& names, DoctorRecording& recording);

bool isCompressed(const DoctorRecording& recording);

}  // namespace ardrone_vslam
