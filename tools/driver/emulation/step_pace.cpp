// SPDX-License-Identifier: BSD-3-Clause
#include "driver/emulation/step_pace.hpp"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace ardrone_vslam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestStall_s = 0.5;

}  // namespace

void StepPace::begin(std::int64_t stamp_ns) {
  begin_ns_ = stamp_ns;
  begin_ = Clock::now();
  step_ = -1;
}

std::int64_t StepPace::await() {
  ++step_;
  const auto due = begin_ + std::chrono::nanoseconds(sinceBegin_ns());
  std::this_thread::sleep_until(due);
  const double late_s = std::chrono::duration<double>(Clock::now() - due).count();
  if (late_s > kLongestStall_s) {
    ROS_WARN_STREAM("this computer stood still for " << late_s << " s; so did the drone");
    const std::int64_t lost_ns = std::llround(late_s * 1e9);
    begin_ += std::chrono::nanoseconds(lost_ns);
    begin_ns_ += lost_ns;
  }
  latest_s_ = std::max(latest_s_, late_s);
  return begin_ns_ + sinceBegin_ns();
}

double StepPace::takeLatest_s() {
  return std::exchange(latest_s_, 0);
}

}  // namespace ardrone_vslam
