// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <string>

#include "driver/driver_link.hpp"
#include "driver/emulation/driver_topics.hpp"
#include "driver/fake_driver_setup.hpp"
#include "driver/fake_drone.hpp"
#include "world/live_camera.hpp"

namespace ardrone_vslam {

/// The drone's video: one of its two cameras streams, exposed at a constant rate.
class VideoStream {
 public:
  /// @param world  as link, outlives this
  VideoStream(const World& world, DriverLink& link, const FakeDriverConfig& config);

  bool isBottom() const { return is_bottom_; }
  void select(bool bottom);

  /// Exposes the image that is due, if one is. It is rendered if anybody watches.
  /// @param moment  at now_ns, which is since_begin_ns after the first one
  void expose(const DroneMoment& moment, std::int64_t now_ns, std::int64_t since_begin_ns,
              const DriverTopics& topics);
  /// Publishes the images that have come over the link.
  void publishArrived(std::int64_t now_ns, DriverTopics& topics);

  /// Warns of images that were not rendered in time since the call before.
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::string activeCamera() const;

  DriverLink& link_;
  std::string front_;  // a name of cameras()
  bool is_bottom_;
  double rate_hz_;
  std::uint64_t seed_;  // of the first image's noise
  std::int64_t exposed_ = 0;
  std::uint64_t lost_before_ = 0;  // at the last diagnostics
  LiveCamera camera_;
};

}  // namespace ardrone_vslam
