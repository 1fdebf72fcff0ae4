// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "ardrone_vslam/odometry_adapter.hpp"
#include "inputs/frame_matcher.hpp"
#include "stamps/stamp_guard.hpp"

namespace ardrone_vslam {

/// Odometry messages -> states: single wrong stamps are left out, drivers' faults repaired.
class OdometryIntake {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit OdometryIntake(const OdometryAdapterConfig& config) : adapter_(config) {}

  /// To be asked before take(): with kAlone the message is to be dropped. What is not after the one
  /// before is the adapter's to judge, as drivers send bursts with one stamp.
  StampGuard::Answer check(std::int64_t stamp_ns) { return stamps_.check(stamp_ns); }
  /// @return why the message, or one held before it, is not used; else empty
  std::string take(const OdometryState& message) {
    ready_.clear();
    return explain(adapter_.push(message, ready_), message);
  }
  /// The states that the last message made ready, stamps ascending.
  const std::vector<OdometryState>& ready() const { return ready_; }
  /// What was wrong with the messages so far, by cause.
  const OdometryFaultCounts& faults() const { return adapter_.faults(); }

 private:
  StampGuard stamps_;
  OdometryAdapter adapter_;
  std::vector<OdometryState> ready_;  // kept for its memory
};

}  // namespace ardrone_vslam
