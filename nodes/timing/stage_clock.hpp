// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>

#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

/// Measures what each stage of one frame takes. The core reads no clock: it tells a hook which
/// stage begins.
class StageClock {
 public:
  /// @return a hook that refers to this timer; forgets the frame before
  StageHook hook() {
    milliseconds_.fill(0);
    current_ = Stage::kIdle;
    return [this](Stage next) { begin(next); };
  }
  double milliseconds(Stage stage) const { return milliseconds_[static_cast<std::size_t>(stage)]; }

 private:
  using Clock = std::chrono::steady_clock;

  void begin(Stage next) {
    const auto now = Clock::now();
    if (current_ != Stage::kIdle) {
      milliseconds_[static_cast<std::size_t>(current_)] +=
          std::chrono::duration<double, std::milli>(now - begun_).count();
    }
    current_ = next;
    begun_ = now;
  }

  std::array<double, kStageCount> milliseconds_{};
  Stage current_ = Stage::kIdle;
  Clock::time_point begun_;
};

}  // namespace ardrone_vslam
