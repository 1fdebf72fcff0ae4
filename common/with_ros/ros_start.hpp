// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// ros::init, which takes ROS's own arguments out. @param options  of ros::init_options
/// @return false when a name among them is none, which is then said: wrong usage, exit code 2
bool startRos(int& argc, char** argv, const std::string& name, unsigned options = 0);

}  // namespace ardrone_vslam
