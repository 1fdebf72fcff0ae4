// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// Of `camera`, also onboard_bridge's.
constexpr const char* kCalibrationFile =
    "file of the camera's calibration, as camera_calibration writes it. For vslam_onboard: of the "
    "size after `halve`, relative to the configuration file. For onboard_bridge: the same; empty: "
    "neither `features` nor `debug_image`. For camera: its full path; empty: what the service "
    "set_camera_info has kept";
constexpr const char* kCameraFrame = "the camera's optical frame";

/// The section `onboard` of a configuration file: what vslam_onboard reads beside `tracker` and
/// `mapper`.
struct OnboardConfig {
  std::string frames = "/dev/video2";
  std::string camera;
  bool halve = false;
  std::string camera_position_m = "[0, 0, 0]";
  std::string camera_rotation_deg = "[-90, 0, -90]";
  bool realtime_clock = false;
  std::string observer = "127.0.0.1:5580";
  std::string pose_address = "127.0.0.1:5581";
  std::string telemetry_address;
  double telemetry_hz = 5;
  int priority = 10;
  double cpu_share = 0.5;
  int working_mb = 12;
  bool lock_memory = false;

  // Options of the program, no parameters: for flights that are played again.
  bool every_frame = false;  ///< no image is dropped for a newer one (a FIFO; files never drop any)
  std::string poses;         ///< file that gets the answers, too; empty: none

  /// Without a good record for so long answers say that the controller is silent. No parameter:
  /// only tests wait for longer.
  double controller_silent_s = 0.5;
};

template <class Visitor>
void visitParameters(OnboardConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"frames", "name", 0, 0,
                      "where images come from: a V4L2 device, a file or FIFO of images "
                      "(docs/onboard.md), or - for standard input"},
        c.frames);
  visit(ParameterInfo{"camera", "name", 0, 0, kCalibrationFile}, c.camera);
  visit(ParameterInfo{"halve", "switch", 0, 0,
                      "images come twice as wide and high as the calibration says: 2 x 2 pixels "
                      "become one"},
        c.halve);
  visit(ParameterInfo{"camera_position_m", "[x, y, z]", 0, 0, "the camera's place in base"},
        c.camera_position_m);
  visit(ParameterInfo{"camera_rotation_deg", "[r, p, y]", 0, 0,
                      "the camera's optical frame to base: roll about base's x first, then pitch "
                      "about its y, then yaw about its z"},
        c.camera_rotation_deg);
  visit(ParameterInfo{"realtime_clock", "switch", 0, 0,
                      "the controller's stamps are of CLOCK_REALTIME, not CLOCK_MONOTONIC: a "
                      "V4L2 camera's images are stamped alike"},
        c.realtime_clock);
  visit(ParameterInfo{"observer", "name", 0, 0,
                      "where the controller's records come from: ADDRESS:PORT, at which UDP "
                      "datagrams are received (0.0.0.0: from other computers, too), or a file or "
                      "FIFO"},
        c.observer);
  visit(ParameterInfo{"pose_address", "name", 0, 0,
                      "ADDRESS:PORT that the answers are sent to, by UDP; empty: to nobody"},
        c.pose_address);
  visit(ParameterInfo{"telemetry_address", "name", 0, 0,
                      "a workstation that gets the answers, too, and features and landmarks "
                      "(onboard_bridge): ADDRESS or ADDRESS:PORT (5582); empty: none"},
        c.telemetry_address);
  visit(ParameterInfo{"telemetry_hz", "Hz", 0.01, 100,
                      "at most so many datagrams a second of features and landmarks, 1400 bytes "
                      "each"},
        c.telemetry_hz);
  visit(
      ParameterInfo{
          "priority", "nice", -20, 19,
          "nice value of the process; above 0: the controller goes first. Below 0 needs root"},
      c.priority);
  visit(ParameterInfo{"cpu_share", "ratio", 0.01, 1,
                      "at most this share of the processor: after an image it waits as long as "
                      "that takes"},
        c.cpu_share);
  visit(ParameterInfo{"working_mb", "MB", 1, 1000,
                      "what all but the landmarks may take; taken from the system at the start, "
                      "with 400 bytes for each of `max_landmarks`"},
        c.working_mb);
  visit(ParameterInfo{"lock_memory", "switch", 0, 0,
                      "program and memory are never paged out; needs root"},
        c.lock_memory);
}

}  // namespace ardrone_vslam
