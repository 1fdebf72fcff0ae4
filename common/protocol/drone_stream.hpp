// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/sequence_guard.hpp"
#include "protocol/telemetry_reader.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {

/// Why a datagram is not used.
enum class DatagramFault {
  kForeign,    ///< does not begin as the protocol's
  kVersion,    ///< of another version of the protocol
  kKind,       ///< of a kind that a workstation does not get
  kSize,       ///< shorter or longer than it says
  kCorrupted,  ///< its CRC is another
  kRefused,    ///< whole, but its numbers cannot be
  kLate        ///< overtaken by a newer one, or there twice
};
constexpr std::size_t kDatagramFaultCount = 7;
/// What is wrong, and what helps.
const char* explain(DatagramFault fault);

/// Whether the drone's map begins anew after this answer.
inline bool beganMapAnew(const VslamPose& answer) {
  return answer.state == VSLAM_NOT_FINITE || answer.state == VSLAM_OUT_OF_MEMORY;
}

/// What a workstation gets of vslam_onboard: answers and telemetry, through one port.
class DroneStream {
 public:
  enum class Read { kNothing, kPose, kTelemetry };
  /// A stamp so far back is a clock that was set, or another one (as the nodelets' StampGuard).
  static constexpr std::int64_t kRestart_ns = 1'000'000'000;

  struct Counts {
    std::uint64_t poses = 0;
    std::uint64_t telemetry = 0;
    std::array<std::uint64_t, kDatagramFaultCount> faults{};  ///< by DatagramFault
    std::uint64_t restarts = 0;  ///< the program was started again, or its clock set

    std::uint64_t of(DatagramFault fault) const { return faults[static_cast<std::size_t>(fault)]; }
    /// Not used, for another reason than being late.
    std::uint64_t bad() const;
  };

  /// @param now_ns  of a clock that does not go back
  /// @return what has come; for kNothing fault() says why
  Read read(const std::uint8_t* datagram, std::size_t size, std::int64_t now_ns);

  /// The newest answer.
  const VslamPose& pose() const { return pose_; }
  const TelemetryReader& telemetry() const { return telemetry_; }
  /// Of the datagram that was dropped last.
  DatagramFault fault() const { return fault_; }
  const Counts& counts() const { return counts_; }
  /// Numbers missing so far; those that came late are among them.
  std::uint64_t posesLost() const { return pose_guard_.lost(); }
  std::uint64_t telemetryLost() const { return telemetry_guard_.lost(); }

 private:
  Read drop(DatagramFault fault);
  Read readPose(const std::uint8_t* datagram, std::size_t size, std::int64_t now_ns);
  Read readTelemetry(const std::uint8_t* datagram, std::size_t size, std::int64_t now_ns);
  void restart();

  VslamPose pose_{};
  std::int64_t stamp_ns_ = 0;  // of the newest image answered
  TelemetryReader telemetry_;
  SequenceGuard pose_guard_;
  SequenceGuard telemetry_guard_;
  DatagramFault fault_ = DatagramFault::kForeign;
  Counts counts_;
};

}  // namespace ardrone_vslam
