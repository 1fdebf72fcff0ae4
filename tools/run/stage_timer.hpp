// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

using StageTimes_ms = std::array<double, kStageCount>;

double total_ms(const StageTimes_ms& times_ms);

/// Accumulates the time between stage changes; the clock that the core does not have.
class StageTimer {
 public:
  explicit StageTimer(StageTimes_ms& times_ms);
  StageHook hook();
  /// Of what comes after this call.
  FrameClock clock() const;

 private:
  void enter(Stage stage);

  StageTimes_ms& times_ms_;
  Stage stage_ = Stage::kIdle;
  std::int64_t since_ns_ = 0;
};

}  // namespace ardrone_vslam
