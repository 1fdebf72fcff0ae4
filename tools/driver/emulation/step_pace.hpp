// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

#include "driver/drone_packet.hpp"

namespace ardrone_vslam {

/// The pace of the drone's packets by the steady clock: a step each 5 ms. While the computer stands
/// still it stands still, too; short delays it catches up.
class StepPace {
 public:
  static constexpr std::int64_t kStep_ns = 5'000'000;
  static_assert(kStep_ns * 200 == 1'000'000'000 && kPacketRate_hz == 200, "a step is a packet's");

  /// The first step is due now. @param stamp_ns  its stamp
  void begin(std::int64_t stamp_ns);
  /// Waits until the next step is due. @return its stamp
  std::int64_t await();

  /// Of this step, from 0 on.
  std::int64_t step() const { return step_; }
  std::int64_t sinceBegin_ns() const { return step_ * kStep_ns; }
  /// How late a step was, at worst since the call before.
  double takeLatest_s();

 private:
  std::chrono::steady_clock::time_point begin_;
  std::int64_t begin_ns_ = 0;  // stamp of the first step
  std::int64_t step_ = -1;
  double latest_s_ = 0;
};

}  // namespace ardrone_vslam
