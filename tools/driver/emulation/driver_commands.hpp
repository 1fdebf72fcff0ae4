// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <mutex>
#include <vector>

#include "driver/emulation/driver_emulation.hpp"
#include "driver/emulation/video_stream.hpp"
#include "driver/fake_drone.hpp"

namespace ardrone_vslam {

/// The topics and services by which drone and driver are commanded.
class DriverCommands {
 public:
  /// @param mutex  held while a command changes one of those behind it; all outlive this
  DriverCommands(ros::NodeHandle nh, std::mutex& mutex, FakeDrone& drone, DriverEmulation& driver,
                 VideoStream& video);

 private:
  void subscribe(ros::NodeHandle& nh);
  void serve(ros::NodeHandle& nh);
  void onCommand(const geometry_msgs::Twist& twist);

  std::mutex& mutex_;
  FakeDrone& drone_;
  DriverEmulation& driver_;
  VideoStream& video_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace ardrone_vslam
