// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/autopilot_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kWatchedFor_ns = 2'000'000'000;

}  // namespace

AutopilotFlight::AutopilotFlight(const FakeDriverConfig& config, const DriverFaults& faults)
    : duration_s_(hasAutopilot(config) ? flightInfo(config.autopilot).duration_s : 0),
      will_restart_(faults.count(DriverFault::kEpochDt) > 0),
      toggles_camera_(faults.count(DriverFault::kTogglecam) > 0),
      begins_with_bottom_(config.camera == "bottom") {}

void AutopilotFlight::beginWhenWatched(std::int64_t now_ns, const DriverTopics& topics,
                                       FakeDrone& drone) {
  if (duration_s_ == 0 || (from_ns_ != 0 && now_ns < from_ns_)) return;
  if (from_ns_ != 0) {
    drone.beginFlight();
  } else if (topics.isWatched()) {
    from_ns_ = now_ns + kWatchedFor_ns;
  }
}

void AutopilotFlight::strikeOnTime(double t_s, DriverEmulation& driver, VideoStream& video) {
  if (duration_s_ == 0) return;
  if (will_restart_ && t_s >= duration_s_ / 2) {
    driver.restart();
    will_restart_ = false;
  }
  if (toggles_camera_) {
    const bool is_middle = t_s >= duration_s_ / 3 && t_s < duration_s_ * 2 / 3;
    video.select(begins_with_bottom_ != is_middle);
  }
}

}  // namespace ardrone_vslam
