// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/driver_commands.hpp"

#include <ardrone_vslam/CamSelect.h>
#include <std_msgs/Empty.h>
#include <std_srvs/Empty.h>

#include <cmath>
#include <string>

namespace ardrone_vslam {
namespace {

constexpr double kWarnPeriod_s = 5;

void answer(const std::string& refusal) {
  if (!refusal.empty()) ROS_WARN_STREAM_THROTTLE(kWarnPeriod_s, refusal);
}

}  // namespace

DriverCommands::DriverCommands(ros::NodeHandle nh, std::mutex& mutex, FakeDrone& drone,
                               DriverEmulation& driver, VideoStream& video)
    : mutex_(mutex), drone_(drone), driver_(driver), video_(video) {
  subscribe(nh);
  serve(nh);
}

void DriverCommands::subscribe(ros::NodeHandle& nh) {
  using Empty = std_msgs::Empty::ConstPtr;
  const auto listenTo = [this, &nh](const std::string& topic, std::string (FakeDrone::*obey)()) {
    subscribers_.push_back(
        nh.subscribe<std_msgs::Empty>("ardrone/" + topic, 1, [this, obey](const Empty&) {
          const std::lock_guard<std::mutex> lock(mutex_);
          answer((drone_.*obey)());
        }));
  };
  listenTo("takeoff", &FakeDrone::takeOff);
  listenTo("land", &FakeDrone::land);
  listenTo("reset", &FakeDrone::reset);
  subscribers_.push_back(nh.subscribe<geometry_msgs::Twist>(
      "cmd_vel", 100, [this](const geometry_msgs::Twist::ConstPtr& twist) { onCommand(*twist); }));
}

void DriverCommands::serve(ros::NodeHandle& nh) {
  using Request = std_srvs::Empty::Request;
  using Response = std_srvs::Empty::Response;
  const auto offer = [this, &nh](const std::string& name, auto action) {
    const boost::function<bool(Request&, Response&)> callback = [this, action](Request&,
                                                                               Response&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      action();
      return true;
    };
    services_.push_back(nh.advertiseService(name, callback));
  };
  offer("ardrone/togglecam", [this] { video_.select(!video_.isBottom()); });
  offer("ardrone/flattrim", [] {});  // its accelerometer has no bias to trim away
  offer("ardrone/restart_driver", [this] { driver_.restart(); });
  const boost::function<bool(CamSelect::Request&, CamSelect::Response&)> select =
      [this](CamSelect::Request& request, CamSelect::Response& response) {
        const std::lock_guard<std::mutex> lock(mutex_);
        video_.select(request.channel % 2 == 1);
        response.result = true;
        return true;
      };
  services_.push_back(nh.advertiseService("ardrone/setcamchannel", select));
}

void DriverCommands::onCommand(const geometry_msgs::Twist& twist) {
  DroneCommand command{twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z};
  command.auto_hover = twist.angular.x == 0 && twist.angular.y == 0;
  for (const double part : {command.forward, command.left, command.up, command.turn_left}) {
    if (std::abs(part) > 1 && std::isfinite(part)) {
      ROS_WARN_STREAM_THROTTLE(kWarnPeriod_s,
                               "cmd_vel is beyond +-1 and cut, as it is no speed "
                               "but a share of the drone's limits");
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  answer(drone_.command(command));
}

}  // namespace ardrone_vslam
