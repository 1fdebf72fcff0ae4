// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/height_jumps.hpp"

#include <cmath>

namespace ardrone_vslam {

bool HeightJumpDetector::see(std::int64_t stamp_ns, double height_m, double climb_m) {
  climbed_m_ += climb_m;
  const double excess_m = height_m - climbed_m_;
  if (stamp_ns < until_ns_) {
    offset_m_ = floor_m_ - excess_m;
    return false;
  }
  recent_.push_back({stamp_ns, excess_m});
  while (stamp_ns - recent_.front().stamp_ns > kWindow_ns) recent_.pop_front();
  const double before_m = recent_.front().excess_m;
  if (!(std::abs(excess_m - before_m) > kLeast_m)) return false;
  floor_m_ = before_m + offset_m_;
  offset_m_ = floor_m_ - excess_m;
  until_ns_ = stamp_ns + kLongest_ns;
  recent_.clear();
  return true;
}

}  // namespace ardrone_vslam
