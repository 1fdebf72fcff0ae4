// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <string>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"
#include "inputs/odometry_maker.hpp"

namespace ardrone_vslam {

/// The AR.Drone's navdata, IMU and commands -> the package's own observer (odometry_mode navdata).
/// Its odom is kObserverFrame, unless there is a name.
class NavdataInput : public OdometryMaker {
 public:
  NavdataInput(ros::NodeHandle& nh, Frames frames, Take take, Refuse refuse);

  void subscribe(ros::NodeHandle& nh) override;
  OdometryFaultCounts faults() const override { return observer_.faults(); }

 private:
  void onNavdata(const NavdataConstPtr& message);
  void onImu(const sensor_msgs::ImuConstPtr& message);
  void onCommand(const geometry_msgs::TwistConstPtr& message);

  DroneObserver observer_;
  std::vector<OdometryState> ready_;  // kept for its memory
  std::string command_topic_;
  std::string imu_topic_;
  std::string navdata_topic_;
  ros::Subscriber command_sub_;
  ros::Subscriber imu_sub_;
  ros::Subscriber navdata_sub_;
};

}  // namespace ardrone_vslam
