// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// What the node fake_driver reads; make_world's options of these names mean the same.
struct FakeDriverConfig {
  std::string autopilot = "none";
  std::string world;
  std::string camera = "front";
  std::string faults = "none";
  std::string odometry_profile = "drone";
  double rate = 20;
  int seed = 0;
  std::string tf_prefix;  ///< ROS's own parameter, for all nodes of a namespace
};

template <class Visitor>
void visitParameters(FakeDriverConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"autopilot", "name", 0, 0,
                      "a flight of make_world --list that it flies by itself; none: on the floor, "
                      "obeying takeoff, land, reset and cmd_vel"},
        c.autopilot);
  visit(
      ParameterInfo{"world", "name", 0, 0,
                    "room, furnished, moving, corridor, hotel; empty: the flight's own, else room"},
      c.world);
  visit(ParameterInfo{"camera", "name", 0, 0,
                      "which streams first: front, front_wide, bottom; togglecam changes to the "
                      "other side's"},
        c.camera);
  visit(
      ParameterInfo{
          "faults", "names", 0, 0,
          "faults of the driver, with commas between them: docs/make_world.md lists them; none; "
          "released: those of every flight with ardrone_autonomy 1.4.1"},
      c.faults);
  visit(ParameterInfo{"odometry_profile", "name", 0, 0,
                      "how the drone's measurements drift (config/odometry_profiles.yaml)"},
        c.odometry_profile);
  visit(ParameterInfo{"rate", "Hz", 0.1, 100, "images a second"}, c.rate);
  visit(ParameterInfo{"seed", "-", 0, 2147483647, "of the noise in all that is measured and seen"},
        c.seed);
}

}  // namespace ardrone_vslam
