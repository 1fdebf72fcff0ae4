// SPDX-License-Identifier: BSD-3-Clause
#include "world/world_arguments.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iomanip>
#include <optional>
#include <sstream>

#include "program/tool_main.hpp"

namespace ardrone_vslam {
namespace {

std::vector<std::string> cameraNames() {
  std::vector<std::string> names;
  for (const auto& camera : cameras()) names.push_back(camera.name);
  return names;
}

std::optional<double> parseGain(const std::string& text) {
  if (text == "auto") return std::nullopt;
  double gain = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf%c", &gain, &rest) != 1 || !(gain > 0) || !(gain <= 100)) {
    throw UsageError("--gain: '" + text + "' must be a number above 0 and up to 100, or auto");
  }
  return gain;
}

}  // namespace

FlightStart parseStart(const std::string& option, const std::string& text) {
  FlightStart start;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &start.x_m, &start.y_m, &start.yaw_rad, &rest) !=
      3) {
    throw UsageError(option + ": '" + text + "' must be X,Y,YAW, for example 1,-0.5,1.57");
  }
  return start;
}

std::string flightList() {
  std::ostringstream list;
  for (const auto& flight : flights()) {
    list << std::left << std::setw(16) << flight.name << flight.summary << " (" << flight.duration_s
         << " s; " << flight.world << ")\n";
  }
  return list.str();
}

std::vector<std::string> flightNames() {
  std::vector<std::string> names;
  for (const auto& flight : flights()) names.push_back(flight.name);
  return names;
}

void addCameraOptions(CLI::App& app, WorldOptions& world, CameraArguments& arguments) {
  const auto oneOf = [](const std::vector<std::string>& names) { return CLI::IsMember(names); };
  app.add_option("--world", world.world, "where; default: the flight's own (--list)")
      ->check(oneOf(worldNames()));
  app.add_option("--light", world.light,
                 "steady; moving: a lamp wanders about; fading: dark from 20 to 32 s, then dim; "
                 "default: the flight's own")
      ->check(oneOf(lightNames()));
  app.add_option("--camera", arguments.camera,
                 "front: 640x360 as its driver's calibration has it, 80 degrees across; "
                 "front_wide: the data sheet's 92 degrees; bottom: 320x240, 64 degrees")
      ->capture_default_str()
      ->check(oneOf(cameraNames()));
  arguments.shutter = app.add_option("--shutter", arguments.shutter_ms,
                                     "how long a row is exposed [ms]: motion blur; default: 0, of "
                                     "fast_blur 16")
                          ->check(numberWithin(0.0, 1000.0));
  arguments.readout =
      app.add_option("--readout", arguments.readout_ms,
                     "how much later the last row is exposed than the first [ms]: rolling "
                     "shutter; default: 0, of fast_blur 25")
          ->check(numberWithin(0.0, 1000.0));
  app.add_option("--gain", arguments.gain, "of light and noise, or auto: to a mean grey of 110")
      ->capture_default_str();
  app.add_option("--image-noise", world.effects.noise_grey,
                 "deviation of the images' white noise at gain 1 [grey]")
      ->capture_default_str()
      ->check(numberWithin(0.0, 100.0));
  app.add_option("--artefacts", world.effects.quantiser,
                 "blocks of 4x4 pixels as H.264 leaves them at this QP, 1 to 51; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, kLargestQuantiser));
}

void setCamera(const CameraArguments& arguments, WorldOptions& world) {
  const FlightInfo& flight = flightInfo(world.flight);
  CameraEffects& effects = world.effects;
  const bool has_shutter = arguments.shutter->count() > 0;
  const bool has_readout = arguments.readout->count() > 0;
  effects.shutter_s = has_shutter ? arguments.shutter_ms / 1000 : flight.shutter_s;
  effects.readout_s = has_readout ? arguments.readout_ms / 1000 : flight.readout_s;
  effects.gain = parseGain(arguments.gain);
  const CameraChoice& camera = cameraNamed(arguments.camera);
  world.camera = camera.intrinsics;
  world.T_body_cam = world.T_base_cam = camera.T_body_cam;
}

}  // namespace ardrone_vslam
