// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <cstdint>
#include <string>

#include "odometry_fusion/correction_queue.hpp"
#include "timing/clock_watch.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// What odometry_fusion says of itself: warnings, diagnostics.
class FusionStatus {
 public:
  struct Topics {
    std::string odometry;
    std::string correction;
  };

  FusionStatus(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
               const std::string& name, Topics topics, const DelayedFusion& fusion,
               const CorrectionQueue& corrections, Warnings& warnings);

  /// Messages have come, to be used or not.
  void hearOdometry() { has_odometry_ = true; }
  void hearCorrection() { has_correction_ = true; }
  void refuseOdometry(const std::string& fault);
  void refuseCorrection(const std::string& fault);
  /// The odometry's stamps jumped back.
  void countRestart() { ++restarts_; }
  /// To be called once a second.
  void endSecond();

 private:
  /// What the node waits for; empty when it publishes.
  std::string waitingFor() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper);

  Topics topics_;
  const DelayedFusion& fusion_;
  const CorrectionQueue& corrections_;
  Warnings& warnings_;
  diagnostic_updater::Updater diagnostics_;
  bool has_odometry_ = false;  // within this second
  bool has_correction_ = false;
  std::string waited_for_;  // in the second before
  Reminder reminder_;
  std::uint64_t corrections_refused_ = 0;
  std::uint64_t odometry_refused_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace ardrone_vslam
