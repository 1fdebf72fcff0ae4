// SPDX-License-Identifier: BSD-3-Clause
#include "run/stage_timer.hpp"

#include <chrono>
#include <numeric>

namespace ardrone_vslam {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

double total_ms(const StageTimes_ms& times_ms) {
  return std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
}

StageTimer::StageTimer(StageTimes_ms& times_ms) : times_ms_(times_ms) {}

StageHook StageTimer::hook() {
  return [this](Stage stage) { enter(stage); };
}

FrameClock StageTimer::clock() const {
  return [begun_ns = now_ns()] { return static_cast<double>(now_ns() - begun_ns) * 1e-6; };
}

void StageTimer::enter(Stage stage) {
  const std::int64_t now = now_ns();
  if (stage_ != Stage::kIdle)
    times_ms_[static_cast<std::size_t>(stage_)] += static_cast<double>(now - since_ns_) * 1e-6;
  stage_ = stage;
  since_ns_ = now;
}

}  // namespace ardrone_vslam
