// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "doctor/recording/doctor_recording.hpp"
#include "doctor/recording/doctor_topics.hpp"

namespace ardrone_vslam {

/// What live topics tell within some seconds. Of the images as many as are tracked keep their
/// pixels.
/// @pre ros::init has been called
/// @param progress  told how many tenths of a second have passed; may be empty
/// @throws std::runtime_error without a master, or when a named topic is not published
DoctorRecording listen(const DoctorTopicNames& names, double seconds,
                       const std::function<void(std::size_t tenths)>& progress);

}  // namespace ardrone_vslam
