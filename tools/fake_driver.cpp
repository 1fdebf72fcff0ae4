// SPDX-License-Identifier: BSD-3-Clause
// fake_driver: an AR.Drone and its driver, live, in a synthetic world.

#include "driver/emulation/fake_driver.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include "with_ros/params.hpp"
#include "with_ros/ros_start.hpp"

namespace {

using namespace ardrone_vslam;

constexpr const char* kHelp =
    "Usage: fake_driver [--help] [--version] [topic:=other] [_parameter:=value]\n"
    "An AR.Drone 2.0 in a synthetic world with ardrone_autonomy's topics and services, live: fly\n"
    "it by ardrone/takeoff, cmd_vel and ardrone/land, or let it fly by _autopilot:=laps.\n"
    "Parameters: docs/parameters.md; the drone, its worlds and faults: docs/make_world.md\n";

FakeDriverConfig readConfig(const ros::NodeHandle& private_nh) {
  FakeDriverConfig config;
  ParamReader reader(private_nh);
  reader.read(config);
  for (const auto& sentence : reader.unknownKeys()) ROS_WARN_STREAM(sentence);
  reader.finish();
  config.tf_prefix = tfPrefixOf(private_nh);
  checkNames(config);
  ROS_INFO_STREAM("fake_driver: " << reader.summary());
  return config;
}

int run(const ros::NodeHandle& nh) {
  if (ros::Time::isSimTime()) {
    ROS_FATAL(
        "fake_driver: /use_sim_time is set, but the drone flies by the computer's clock: "
        "rosparam set /use_sim_time false");
    return 1;
  }
  const FakeDriverConfig config = readConfig(ros::NodeHandle("~"));
  const DriverFaults faults = faultsOf(config);
  if (!hasAutopilot(config) &&
      faults.count(DriverFault::kEpochDt) + faults.count(DriverFault::kTogglecam) > 0) {
    ROS_INFO(
        "fake_driver: without an autopilot the fault epoch_dt strikes at each call of the service "
        "ardrone/restart_driver, togglecam at each of ardrone/togglecam");
  }
  FakeDriver driver(nh, config);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  driver.run();
  spinner.stop();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (!startRos(argc, argv, "ardrone_driver")) return 2;
  if (argc > 1) {
    const std::string argument = argv[1];
    const bool is_help = argument == "--help" || argument == "-h";
    if (is_help) std::fputs(kHelp, stdout);
    if (argument == "--version") std::puts("fake_driver (ardrone_vslam) " ARDRONE_VSLAM_VERSION);
    if (is_help || argument == "--version") return 0;
    std::fprintf(stderr, "fake_driver: unknown argument '%s'; --help tells those known\n", argv[1]);
    return 2;
  }
  const ros::NodeHandle nh;  // outlives what is thrown, so that the message gets out
  try {
    return run(nh);
  } catch (const std::exception& e) {
    ROS_FATAL_STREAM("fake_driver: " << e.what());
    return 1;
  }
}
