// SPDX-License-Identifier: BSD-3-Clause
// How programs ask their user for a world and its camera.
#pragma once

#include <string>
#include <vector>

#include "world/world_sequence.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
class Option;
}  // namespace CLI

namespace ardrone_vslam {

/// @param text  X,Y,YAW. @throws UsageError naming the option when it is none
FlightStart parseStart(const std::string& option, const std::string& text);

/// A line for each flight: name, summary, duration, world.
std::string flightList();
std::vector<std::string> flightNames();

/// What setCamera needs of the command line.
struct CameraArguments {
  std::string camera = "front";
  std::string gain = "1";
  double shutter_ms = 0;
  double readout_ms = 0;
  const CLI::Option* shutter = nullptr;
  const CLI::Option* readout = nullptr;
};

/// --world, --light, --camera and what lies between light and image.
void addCameraOptions(CLI::App& app, WorldOptions& world, CameraArguments& arguments);
/// Camera, mounting (base is the middle of the drone) and effects as asked for, else as
/// world.flight has them. @throws UsageError for a gain that is none
void setCamera(const CameraArguments& arguments, WorldOptions& world);

}  // namespace ardrone_vslam
