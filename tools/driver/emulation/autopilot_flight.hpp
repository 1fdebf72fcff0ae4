// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "driver/driver_faults.hpp"
#include "driver/emulation/driver_emulation.hpp"
#include "driver/emulation/driver_topics.hpp"
#include "driver/emulation/video_stream.hpp"
#include "driver/fake_driver_setup.hpp"
#include "driver/fake_drone.hpp"

namespace ardrone_vslam {

/// When the flight that the drone flies by itself begins, and when the faults strike that a bag of
/// it has. Without an autopilot neither: those faults have services.
class AutopilotFlight {
 public:
  AutopilotFlight(const FakeDriverConfig& config, const DriverFaults& faults);

  /// So that whoever looks on sees the whole flight: 2 s after the first image was asked for.
  void beginWhenWatched(std::int64_t now_ns, const DriverTopics& topics, FakeDrone& drone);
  /// @param t_s  since the flight began
  void strikeOnTime(double t_s, DriverEmulation& driver, VideoStream& video);

 private:
  double duration_s_;    // 0: no autopilot
  bool will_restart_;    // the driver, at half of the flight
  bool toggles_camera_;  // for its middle third
  bool begins_with_bottom_;
  std::int64_t from_ns_ = 0;  // 0: nobody watches yet
};

}  // namespace ardrone_vslam
