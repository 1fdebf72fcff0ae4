// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// Keeps work to a share of the processor: after work of c the next may begin no earlier than
/// c / share after this one began.
class CpuShare {
 public:
  explicit CpuShare(double share) : share_(share) {}

  void begin(std::int64_t now_ns, std::int64_t cpu_ns) {
    began_ns_ = now_ns;
    cpu_ns_ = cpu_ns;
  }
  /// @return c
  std::int64_t end(std::int64_t cpu_ns) {
    const std::int64_t cost_ns = cpu_ns - cpu_ns_;
    next_ns_ = began_ns_ + static_cast<std::int64_t>(static_cast<double>(cost_ns) / share_);
    return cost_ns;
  }
  /// Of the next work; in the past: it may begin.
  std::int64_t next_ns() const { return next_ns_; }

 private:
  double share_;
  std::int64_t began_ns_ = 0;
  std::int64_t cpu_ns_ = 0;
  std::int64_t next_ns_ = 0;
};

}  // namespace ardrone_vslam
