// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/parameters.hpp"
#include "driver/driver_faults.hpp"
#include "driver/fake_drone.hpp"
#include "world/world.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {

/// What the node fake_driver reads; make_world's options of these names mean the same.
struct FakeDriverConfig {
  std::string autopilot = "none";
  std::string world;
  std::string light;
  std::string start;
  std::string camera = "front";
  std::string faults = "none";
  std::string odometry_profile = "drone";
  std::string tf_prefix;
  double rate = 20;
  double wind = 0.2;
  int seed = 0;
  int world_seed = 0;
  double readout = 0;
  double shutter = 0;
  double gain = 1;
  double image_noise = 2;
  int artefacts = 0;
  int render_threads = 1;
};

template <class Visitor>
void visitParameters(FakeDriverConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"autopilot", "name", 0, 0,
                      "a flight of make_world --list that it flies by itself; none: on the floor, "
                      "obeying takeoff, land, reset and cmd_vel"},
        c.autopilot);
  visit(ParameterInfo{"world", "name", 0, 0,
                      "room, furnished, moving, corridor; empty: the flight's own, else room"},
        c.world);
  visit(ParameterInfo{"light", "name", 0, 0, "steady, moving, fading; empty: likewise"}, c.light);
  visit(ParameterInfo{"start", "X,Y,YAW", 0, 0,
                      "where it stands or its flight begins; empty: where the flight, or laps, "
                      "do"},
        c.start);
  visit(ParameterInfo{"camera", "name", 0, 0,
                      "which streams first: front, front_wide, bottom; togglecam changes to the "
                      "other side's"},
        c.camera);
  visit(
      ParameterInfo{"faults", "names", 0, 0,
                    "of the driver, with commas between them: docs/make_world.md lists them; none; "
                    "released: those of every flight with ardrone_autonomy 1.4.1"},
      c.faults);
  visit(ParameterInfo{"odometry_profile", "name", 0, 0,
                      "how the drone's measurements drift (config/odometry_profiles.yaml)"},
        c.odometry_profile);
  visit(ParameterInfo{"tf_prefix", "name", 0, 0,
                      "before all frames; empty: none, with the fault unprefixed_frame drone1"},
        c.tf_prefix);
  visit(ParameterInfo{"rate", "Hz", 0.1, 100, "of the images"}, c.rate);
  visit(ParameterInfo{"wind", "m/s", 0, 3,
                      "deviation of the air's speed: a fifth of it moves a hovering drone"},
        c.wind);
  visit(ParameterInfo{"seed", "-", 0, 2147483647, "of all noise"}, c.seed);
  visit(ParameterInfo{"world_seed", "-", 0, 2147483647, "of what is where"}, c.world_seed);
  visit(ParameterInfo{"readout", "ms", 0, 1000, "rolling shutter: last row after the first one"},
        c.readout);
  visit(ParameterInfo{"shutter", "ms", 0, 1000, "each row's exposure: motion blur, slow to render"},
        c.shutter);
  visit(ParameterInfo{"gain", "-", 0, 100, "of light and noise; 0: automatic"}, c.gain);
  visit(ParameterInfo{"image_noise", "grey", 0, 100, "deviation of the images' white noise"},
        c.image_noise);
  visit(ParameterInfo{"artefacts", "QP", 0, kLargestQuantiser, "blocks as H.264's; 0: none"},
        c.artefacts);
  visit(ParameterInfo{"render_threads", "threads", 1, 64, "that render one image"},
        c.render_threads);
}

/// @throws std::invalid_argument that names the parameter whose text is not known, and what is
void checkNames(const FakeDriverConfig& config);

/// What the texts mean. @throws std::invalid_argument, UsageError or std::runtime_error naming what
/// is not known and what is
bool hasAutopilot(const FakeDriverConfig& config);
DriverFaults faultsOf(const FakeDriverConfig& config);
World worldOf(const FakeDriverConfig& config);
FakeDroneOptions droneOf(const FakeDriverConfig& config);
CameraEffects effectsOf(const FakeDriverConfig& config);
std::string prefixOf(const FakeDriverConfig& config, const DriverFaults& faults);

}  // namespace ardrone_vslam
