// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/clock_map.hpp"
#include "timing/warning_limiter.hpp"

namespace ardrone_vslam {

/// The stamps of the drone's images, by this computer's clock.
class DroneClock {
 public:
  /// @param is_same  the drone's clock is this computer's: checks whether it is
  DroneClock(bool is_same, Warnings& warnings) : is_same_(is_same), warnings_(warnings) {}

  /// @return nothing for an image before the newest
  std::optional<std::int64_t> toOwn(std::int64_t drone_ns);
  /// Whether the stamp, by the drone's clock, is that of the newest image.
  bool isNewest(std::int64_t drone_ns) const { return drone_ns == drone_ns_; }
  /// Of the newest image, by this computer's clock.
  std::int64_t newest_ns() const { return own_ns_; }
  /// The drone's clock was set, or began again.
  void clear();

  /// With the same clock: that it is not, and what helps; else empty.
  const std::string& fault() const { return fault_; }
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& wrapper) const;

 private:
  void check(std::int64_t drone_ns);

  bool is_same_;
  Warnings& warnings_;
  ClockMap map_;
  std::int64_t drone_ns_ = 0;  // stamp of the newest image, by the drone's clock
  std::int64_t own_ns_ = 0;    // and by this computer's
  std::string fault_;
};

}  // namespace ardrone_vslam
