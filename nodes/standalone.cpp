// SPDX-License-Identifier: BSD-3-Clause
#include "standalone.hpp"

#include <nodelet/loader.h>
#include <ros/ros.h>

#include <iostream>

#include "with_ros/ros_start.hpp"

namespace ardrone_vslam {
namespace {

void printHelp(const std::string& name, const std::string& type) {
  std::cout << "Usage: " << name
            << "_node [--help] [--version] [topic:=other] [_parameter:=value]\n"
            << "Runs the nodelet " << type << " as a node of its own.\n"
            << "Topics, parameters and frames: README.md and docs/parameters.md\n";
}

}  // namespace

int runStandalone(int argc, char** argv, const std::string& name, const std::string& type) {
  if (!startRos(argc, argv, name)) return 2;
  if (argc > 1) {
    const std::string argument = argv[1];
    if (argument == "--help" || argument == "-h") {
      printHelp(name, type);
      return 0;
    }
    if (argument == "--version") {
      std::cout << "ardrone_vslam " ARDRONE_VSLAM_VERSION "\n";
      return 0;
    }
    std::cerr << "unknown argument '" << argument << "'; --help tells those known\n";
    return 2;
  }
  nodelet::Loader loader(false);
  const nodelet::M_string remappings(ros::names::getRemappings());
  if (!loader.load(ros::this_node::getName(), type, remappings, {})) {
    std::cerr << "the nodelet " << type
              << " did not start: the log says why; its library is found by the workspace's "
                 "setup.bash\n";
    return 1;
  }
  ros::spin();
  return 0;
}

}  // namespace ardrone_vslam
