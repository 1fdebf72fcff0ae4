// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstdint>
#include <mutex>
#include <vector>

#include "driver/driver_link.hpp"
#include "driver/emulation/autopilot_flight.hpp"
#include "driver/emulation/driver_commands.hpp"
#include "driver/emulation/driver_emulation.hpp"
#include "driver/emulation/driver_topics.hpp"
#include "driver/emulation/step_pace.hpp"
#include "driver/emulation/video_stream.hpp"
#include "driver/fake_driver_setup.hpp"
#include "driver/fake_drone.hpp"

namespace ardrone_vslam {

/// ardrone_autonomy and the drone behind it, live: the topics, services, frames, rates and stamps
/// of writeDriverBag, as the clock goes. Besides truth/pose: T of the drone in the map whose origin
/// is where it was switched on (with the prefix, as vslam.launch puts it before all frames). Stamps
/// are times of reception, counted on by the steady clock.
class FakeDriver {
 public:
  /// Paints the world: takes about a second.
  /// @throws std::invalid_argument, UsageError, std::runtime_error for parameters that cannot be
  FakeDriver(const ros::NodeHandle& nh, const FakeDriverConfig& config);

  /// Until ROS ends. Callbacks need a spinner of their own.
  void run();

 private:
  void step(std::int64_t now_ns);
  void receivePackets(std::int64_t now_ns);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  DriverFaults faults_;
  std::mutex mutex_;  // of drone_, driver_ and the camera that streams: commands_ use them, too
  FakeDrone drone_;
  DriverEmulation driver_;
  DriverLink link_;
  std::vector<DronePacket> held_;  // that the link has not handed over
  VideoStream video_;
  AutopilotFlight autopilot_;
  StepPace pace_;
  DriverTopics topics_;
  DriverCommands commands_;
  diagnostic_updater::Updater diagnostics_;
};

}  // namespace ardrone_vslam
