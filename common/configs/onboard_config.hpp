// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ardrone_vslam/parameters.hpp"

namespace ardrone_vslam {

/// The section `onboard` of a configuration file: what vslam_onboard reads beside `tracker` and
/// `mapper`.
struct OnboardConfig {
  std::string frames = "/dev/video2";
  std::string camera;
  bool halve = false;
  double camera_x_m = 0;
  double camera_y_m = 0;
  double camera_z_m = 0;
  double camera_roll_deg = -90;
  double camera_pitch_deg = 0;
  double camera_yaw_deg = -90;
  bool every_frame = false;
  bool realtime_clock = false;
  std::string observer;
  std::string observer_address = "127.0.0.1";
  int observer_port = 5580;
  double controller_silent_s = 0.5;
  std::string poses;
  std::string pose_address = "127.0.0.1";
  int pose_port = 5581;
  std::string telemetry_address;
  int telemetry_port = 5582;
  double telemetry_hz = 5;
  std::string map;
  int priority = 10;
  double cpu_share = 0.5;
  int max_map_mb = 16;
  int working_mb = 12;
  bool lock_memory = false;
};

template <class Visitor>
void visitParameters(OnboardConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"frames", "name", 0, 0,
                      "where images come from: a V4L2 device, a file or FIFO of images "
                      "(docs/onboard.md), or - for standard input"},
        c.frames);
  visit(ParameterInfo{"camera", "name", 0, 0,
                      "file of the camera's calibration, as camera_calibration writes it, for the "
                      "size after halving; relative to the configuration file"},
        c.camera);
  visit(ParameterInfo{"halve", "switch", 0, 0,
                      "images come twice as wide and high as the calibration says: 2 x 2 pixels "
                      "become one"},
        c.halve);
  visit(ParameterInfo{"camera_x_m", "m", -100, 100, "the camera's place in base"}, c.camera_x_m);
  visit(ParameterInfo{"camera_y_m", "m", -100, 100, "likewise"}, c.camera_y_m);
  visit(ParameterInfo{"camera_z_m", "m", -100, 100, "likewise"}, c.camera_z_m);
  visit(ParameterInfo{"camera_roll_deg", "deg", -360, 360,
                      "optical frame to base: about base's x first, then y, then z"},
        c.camera_roll_deg);
  visit(ParameterInfo{"camera_pitch_deg", "deg", -360, 360, "likewise, about y"},
        c.camera_pitch_deg);
  visit(ParameterInfo{"camera_yaw_deg", "deg", -360, 360, "likewise, about z"}, c.camera_yaw_deg);
  visit(ParameterInfo{"every_frame", "switch", 0, 0,
                      "no image is dropped for a newer one (a FIFO; files never drop any)"},
        c.every_frame);
  visit(ParameterInfo{"realtime_clock", "switch", 0, 0,
                      "the controller's stamps are of CLOCK_REALTIME, not CLOCK_MONOTONIC: a "
                      "V4L2 camera's images are stamped alike"},
        c.realtime_clock);
  visit(ParameterInfo{"observer", "name", 0, 0,
                      "file or FIFO with the controller's records; empty: UDP"},
        c.observer);
  visit(ParameterInfo{"observer_address", "name", 0, 0,
                      "records are received at this address; 0.0.0.0: from other computers, too"},
        c.observer_address);
  visit(ParameterInfo{"observer_port", "port", 0, 65535, "and UDP port"}, c.observer_port);
  visit(ParameterInfo{"controller_silent_s", "s", 0.001, 60,
                      "without a good record for so long the answer says that the controller is "
                      "silent"},
        c.controller_silent_s);
  visit(ParameterInfo{"poses", "name", 0, 0, "file that gets the answers, too; empty: none"},
        c.poses);
  visit(ParameterInfo{"pose_address", "name", 0, 0, "the answers are sent there"}, c.pose_address);
  visit(ParameterInfo{"pose_port", "port", 0, 65535, "to this UDP port; 0: not sent"}, c.pose_port);
  visit(ParameterInfo{"telemetry_address", "name", 0, 0,
                      "a workstation that gets the answers, too, and features and landmarks "
                      "(onboard_bridge); empty: none"},
        c.telemetry_address);
  visit(ParameterInfo{"telemetry_port", "port", 1, 65535, "at this UDP port"}, c.telemetry_port);
  visit(ParameterInfo{"telemetry_hz", "Hz", 0.01, 100, "at most so often, 1400 bytes each"},
        c.telemetry_hz);
  visit(ParameterInfo{"map", "name", 0, 0,
                      "file that gets the landmarks at the end, as replay's landmarks.csv; empty: "
                      "none"},
        c.map);
  visit(ParameterInfo{"priority", "nice", -20, 19,
                      "of the process; above 0: the controller goes first. Below 0 needs root"},
        c.priority);
  visit(ParameterInfo{"cpu_share", "ratio", 0.01, 1,
                      "at most this share of the processor: after an image it waits as long as "
                      "that takes"},
        c.cpu_share);
  visit(ParameterInfo{"max_map_mb", "MB", 1, 1000,
                      "what the landmarks may take: bounds mapper/max_landmarks"},
        c.max_map_mb);
  visit(ParameterInfo{"working_mb", "MB", 1, 1000,
                      "what all else may take; both are taken from the system at the start"},
        c.working_mb);
  visit(ParameterInfo{"lock_memory", "switch", 0, 0,
                      "program and memory are never paged out; needs root"},
        c.lock_memory);
}

}  // namespace ardrone_vslam
