// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ardrone_vslam/CamSelect.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "driver/driver_link.hpp"
#include "driver/emulation/driver_emulation.hpp"
#include "driver/fake_driver_config.hpp"
#include "driver/fake_drone.hpp"
#include "world/live_camera.hpp"

namespace ardrone_vslam {

/// ardrone_autonomy and the drone behind it, live: the topics, services, frames, rates and stamps
/// of writeDriverBag, as the clock goes. Besides truth/pose: T of the drone in the map whose origin
/// is where it was switched on (with the prefix, as vslam.launch puts it before all frames). Stamps
/// are times of reception, counted on by the steady clock.
class FakeDriver {
 public:
  /// Paints the world: takes about a second.
  /// @throws std::invalid_argument, UsageError, std::runtime_error for parameters that cannot be
  FakeDriver(ros::NodeHandle nh, const FakeDriverConfig& config);

  /// Until ROS ends. Callbacks need a spinner of their own.
  void run();

 private:
  struct Held {
    DronePacket packet;
    std::int64_t measured_ns;
  };

  bool has(DriverFault fault) const { return faults_.count(fault) > 0; }
  void advertise();
  void listen();
  void step(std::int64_t now_ns);
  void beginFlightWhenWatched(std::int64_t now_ns);
  void strikeOnTime(double t_s);
  void receivePackets(std::int64_t now_ns);
  void exposeImages(const DroneMoment& moment, std::int64_t now_ns);
  void publishTruth(const Eigen::Isometry3d& T_world_base, std::int64_t stamp_ns);
  void publishImage(const CameraShot& shot);
  bool isWatched() const;
  const std::string& activeCamera() const { return is_bottom_ ? kBottom : front_; }
  void answer(const std::string& refusal) const;
  void onCommand(const geometry_msgs::Twist& twist);
  void selectCamera(bool bottom);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  static const std::string kBottom;

  ros::NodeHandle nh_;
  FakeDriverConfig config_;
  DriverFaults faults_;
  std::string front_;  // a name of cameras()
  std::mutex mutex_;   // of drone_, driver_ and is_bottom_, which callbacks use, too
  FakeDrone drone_;
  DriverEmulation driver_;
  std::string map_frame_;
  bool is_bottom_;
  DriverLink link_;
  LiveCamera camera_;
  std::vector<Held> held_;     // packets that the link has not handed over
  std::int64_t begin_ns_ = 0;  // stamp of the first step
  std::int64_t steps_ = 0;
  std::int64_t images_ = 0;          // exposed
  std::int64_t flight_from_ns_ = 0;  // 0: nobody watches yet
  double flight_s_ = 0;              // how long the autopilot's flight takes; 0: no autopilot
  bool restarted_ = false;
  std::uint64_t lost_before_ = 0;  // images, at the last diagnostics
  double latest_s_ = 0;            // how late a step was, at worst since the last diagnostics

  image_transport::ImageTransport transport_;
  std::map<std::string, image_transport::CameraPublisher> images_pub_;  // by name in /ardrone
  ros::Publisher navdata_pub_, imu_pub_, mag_pub_, odometry_pub_, truth_pub_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  tf2_ros::TransformBroadcaster tf_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace ardrone_vslam
