// SPDX-License-Identifier: BSD-3-Clause
#include "with_ros/ros_start.hpp"

#include <ros/exceptions.h>
#include <ros/init.h>

#include <iostream>

namespace ardrone_vslam {

bool startRos(int& argc, char** argv, const std::string& name, unsigned options) {
  try {
    ros::init(argc, argv, name, options);
    return true;
  } catch (const ros::InvalidNameException& e) {
    std::cerr << name << ": a name among the arguments cannot be: " << e.what() << '\n';
    return false;
  }
}

}  // namespace ardrone_vslam
