// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

namespace ardrone_vslam::bench {

/// The thread's own time [ns]: other work on the machine does not count.
inline double threadTime_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace ardrone_vslam::bench
