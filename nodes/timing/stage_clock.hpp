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
    frame_begun_ = Clock::now();
    return [this](Stage next) { begin(next); };
  }
  /// Of the frame since hook().
  FrameClock frameClock() const {
    return [this] { return milliseconds(Clock::now() - frame_begun_); };
  }
  double milliseconds(Stage stage) const { return milliseconds_[static_cast<std::size_t>(stage)]; }

 private:
  using Clock = std::chrono::steady_clock;

  static double milliseconds(Clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
  }
  void begin(Stage next) {
    const auto now = Clock::now();
    if (current_ != Stage::kIdle) {
      milliseconds_[static_cast<std::size_t>(current_)] += milliseconds(now - begun_);
    }
    current_ = next;
    begun_ = now;
  }

  std::array<double, kStageCount> milliseconds_{};
  Stage current_ = Stage::kIdle;
  Clock::time_point begun_;
  Clock::time_point frame_begun_;
};

}  // namespace ardrone_vslam
