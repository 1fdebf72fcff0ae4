// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <mutex>
#include <string>

#include "bridge/drone_clock.hpp"
#include "bridge/features_output.hpp"
#include "conversions/conversions.hpp"
#include "protocol/drone_stream.hpp"

namespace ardrone_vslam {

/// What onboard_bridge says of the drone and of itself: status, warnings, diagnostics.
class BridgeStatus {
 public:
  struct Parts {
    std::mutex& mutex;  ///< of what follows: locked by diagnose() and endSecond(); all others of
                        ///< this class are called with it
    const DroneStream& stream;
    const DroneClock& clock;
    const FeaturesOutput* features;  ///< with a calibration
  };
  /// Names for users.
  struct Names {
    std::string node;
    std::string receiving_at;  ///< address and port
    std::string map_frame;
  };

  BridgeStatus(ros::NodeHandle nh, const ros::NodeHandle& private_nh, const Names& names,
               const Parts& parts, Warnings& warnings);

  /// Something good has come.
  void hear();
  /// An answer, with or without a pose.
  void publishAnswer(Status& status, bool has_pose);
  /// Telemetry of another image than the newest answer's.
  void countLateTelemetry() { ++telemetry_late_; }
  /// To be called once a second.
  void endSecond();
  /// As published last.
  const Status& latest() const { return latest_; }

 private:
  void publish(Status& status);
  void remind();
  bool isSilent() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);
  unsigned char level() const;

  Names names_;
  Parts parts_;
  Warnings& warnings_;
  ros::Publisher publisher_;
  diagnostic_updater::Updater diagnostics_;
  Status latest_;
  std::int64_t heard_ns_ = 0;  // when something good came last, by the monotonic clock; 0: nothing
  std::uint64_t poses_ = 0;
  std::uint64_t telemetry_late_ = 0;
  int seconds_without_pose_ = 0;
};

}  // namespace ardrone_vslam
