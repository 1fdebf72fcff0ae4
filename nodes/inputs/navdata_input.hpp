// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/Navdata.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <functional>
#include <string>
#include <vector>

#include "ardrone_vslam/drone_observer.hpp"

namespace ardrone_vslam {

/// The AR.Drone's navdata, IMU and commands -> the package's own observer (odometry_mode navdata).
/// It is published (`observer_odometry`) and handed on as if it had been received.
class NavdataInput {
 public:
  struct Frames {
    std::string odom = "";  ///< empty: kObserverFrame
    std::string base = "";  ///< empty: the navdata's frame_id
    std::string tf_prefix = "";
  };
  using Take = std::function<void(const nav_msgs::OdometryConstPtr&)>;
  /// Of a message that is not used: its topic, and why.
  using Refuse = std::function<void(const std::string& topic, const std::string& fault)>;

  /// Callbacks run in the queue of `nh`.
  NavdataInput(ros::NodeHandle nh, Frames frames, Take take, Refuse refuse);

  /// Of navdata.
  const ros::Subscriber& subscriber() const { return navdata_sub_; }
  const OdometryFaultCounts& faults() const { return observer_.faults(); }

 private:
  void onNavdata(const NavdataConstPtr& message);
  void onImu(const sensor_msgs::ImuConstPtr& message);
  void onCommand(const geometry_msgs::TwistConstPtr& message);
  void publishReady();

  Frames frames_;
  Take take_;
  Refuse refuse_;
  DroneObserver observer_;
  std::vector<OdometryState> ready_;  // kept for its memory
  ros::Publisher odometry_pub_;
  ros::Subscriber command_sub_;
  ros::Subscriber imu_sub_;
  ros::Subscriber navdata_sub_;
};

}  // namespace ardrone_vslam
