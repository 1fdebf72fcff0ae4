// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <string>

#include "inputs/attitude_input.hpp"
#include "parameters/parameter_changes.hpp"
#include "tracker/image_watch.hpp"
#include "tracker/live_tracker.hpp"

namespace ardrone_vslam {

/// What the tracker says of itself: warnings, diagnostics.
class TrackerStatus {
 public:
  struct Parts {
    const ImageReceiver& images;
    const LiveTracker& tracker;
    const ParameterChanges<TrackerChanges>& changes;
    const AttitudeInput* attitude;  ///< with use_attitude
  };

  TrackerStatus(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                const std::string& name, const Parts& parts, Warnings& warnings);

  /// An image was processed. @return how many so far
  std::uint64_t countProcessed();
  /// An image was dropped. @param fault  its topic, and what helps
  void drop(const std::string& fault);
  std::uint64_t dropped() const { return dropped_; }
  /// To be called once a second.
  void endSecond();

 private:
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  Parts parts_;
  Warnings& warnings_;
  ImageWatch watch_;
  diagnostic_updater::Updater diagnostics_;
  std::uint64_t processed_ = 0;
  std::uint64_t processed_before_ = 0;  // a second ago
  double rate_hz_ = 0;
  std::uint64_t dropped_ = 0;
  std::string fault_;  // of the latest dropped image; empty once one is processed
};

}  // namespace ardrone_vslam
