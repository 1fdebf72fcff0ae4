// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

#include <cstdint>

namespace ardrone_vslam {

inline std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Stamps beyond it (the year 2096) are damage; sums of stamps below it do not overflow.
constexpr std::int64_t kLatestStamp_ns = 4'000'000'000'000'000'000;

/// Never goes back.
inline std::int64_t now_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}

}  // namespace ardrone_vslam
