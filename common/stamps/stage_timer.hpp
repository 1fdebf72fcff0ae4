// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <numeric>

#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

/// By Stage.
using StageTimes_ms = std::array<double, kStageCount>;

inline double total_ms(const StageTimes_ms& times_ms) {
  return std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
}

/// Adds up what each stage of a frame takes: the clock that the core does not have.
class StageTimer {
 public:
  explicit StageTimer(StageTimes_ms& times_ms) : times_ms_(times_ms) {}

  /// @return a hook that refers to this timer
  StageHook hook() {
    return [this](Stage next) {
      const Clock::time_point now = Clock::now();
      if (stage_ != Stage::kIdle)
        times_ms_[static_cast<std::size_t>(stage_)] += in_ms(now - begun_);
      stage_ = next;
      begun_ = now;
    };
  }
  /// Of what comes after this call.
  static FrameClock clock() {
    return [begun = Clock::now()] { return in_ms(Clock::now() - begun); };
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double in_ms(Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
  }

  StageTimes_ms& times_ms_;
  Stage stage_ = Stage::kIdle;
  Clock::time_point begun_;
};

}  // namespace ardrone_vslam
