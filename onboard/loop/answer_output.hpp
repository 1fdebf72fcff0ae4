// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "ardrone_vslam/slam.hpp"
#include "configs/onboard_config.hpp"
#include "loop/pose_pipeline.hpp"
#include "protocol/file_descriptor.hpp"
#include "protocol/telemetry.hpp"
#include "protocol/vslam_protocol.h"

namespace ardrone_vslam {

/// Sends what the program has to say; nobody there to receive it is no fault.
class AnswerOutput {
 public:
  struct Counters {
    std::uint32_t frames_dropped = 0;
    std::uint32_t records_dropped = 0;
    std::uint32_t landmarks = 0;
  };

  /// @throws std::runtime_error
  explicit AnswerOutput(const OnboardConfig& config);

  void sendPose(const FrameResult& result, const Counters& counters);
  /// Without a pose. @param state  VSLAM_...
  void sendState(std::uint32_t state, std::int64_t stamp_ns, const Counters& counters);
  /// On the terminal, when a fault of the set-up begins, changes or ends, and when the images' time
  /// offset was found.
  void saySetup(const SetupMonitor& setup);
  /// At most telemetry_hz.
  void sendTelemetry(const ImageFeatures& features, const Landmarks& map, std::int64_t now_ns);

 private:
  void send(VslamPose& pose, const Counters& counters);

  FileDescriptor pose_socket_;
  FileDescriptor pose_file_;
  FileDescriptor telemetry_socket_;
  std::int64_t telemetry_period_ns_;
  std::int64_t telemetry_sent_ns_ = 0;
  Telemetry telemetry_;
  std::array<std::uint8_t, Telemetry::kBytes> datagram_{};
  std::uint32_t sequence_ = 0;
  double said_offset_s_ = 0;
  SetupFault said_fault_ = SetupFault::kNone;
};

}  // namespace ardrone_vslam
