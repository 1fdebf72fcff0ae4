// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_topics.hpp"

namespace ardrone_vslam {

/// All that doctor looks at of a bag. The images' pixels stay in the bag, which the recording keeps
/// open.
/// @param progress  told how many of how many messages have been read; may be empty
/// @throws std::runtime_error naming the file, the fault and the remedy, for a bag that cannot be
/// read and for a named topic that is not there
DoctorRecording readForDoctor(
    const std::string& path, const DoctorTopicNames& names,
    const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace ardrone_vslam
