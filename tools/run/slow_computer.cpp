// SPDX-License-Identifier: BSD-3-Clause
#include "run/slow_computer.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {

std::size_t SlowComputer::next(const Sequence& sequence, std::size_t index, double measured_ms) {
  const double cost_ms = speed_.cpu_factor * speed_.image_ms.value_or(measured_ms);
  free_ns_ = std::max(free_ns_, sequence.stamp_ns(index)) + std::llround(cost_ms * 1e6);
  std::size_t next = index + 1;
  while (next + 1 < sequence.size() && sequence.stamp_ns(next + 1) <= free_ns_) {
    ++next;
    ++dropped_;
  }
  return next;
}

}  // namespace ardrone_vslam
