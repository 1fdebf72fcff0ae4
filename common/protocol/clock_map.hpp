// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace ardrone_vslam {

/// Another computer's stamps by one's own clock, from when they arrive: what arrived fastest in the
/// last half to whole minute tells how far the clocks are apart. By as much as that one took, all
/// stamps are late: no clock can tell the two from each other. Older arrivals are forgotten, as
/// clocks drift (50 ppm: 3 ms a minute).
class ClockMap {
 public:
  static constexpr std::int64_t kWindow_ns = 30'000'000'000;

  /// @param stamp_ns    by the other clock: positive, after the one before
  /// @param arrival_ns  by one's own
  /// @return the stamp by one's own clock: at most arrival_ns, unless two are out of order by it;
  /// ascends as the stamps do
  std::int64_t map(std::int64_t stamp_ns, std::int64_t arrival_ns) {
    const std::int64_t offset_ns = arrival_ns - stamp_ns;
    // Own clock set back, or so long without any that both windows are old.
    if (!is_begun_ || arrival_ns < begin_ns_ || arrival_ns - begin_ns_ >= 2 * kWindow_ns) {
      *this = {};
      is_begun_ = true;
      begin_ns_ = arrival_ns;
      least_ns_ = before_ns_ = offset_ns;
    } else if (arrival_ns - begin_ns_ >= kWindow_ns) {
      begin_ns_ = arrival_ns;
      before_ns_ = least_ns_;
      least_ns_ = offset_ns;
    }
    least_ns_ = std::min(least_ns_, offset_ns);
    // A fast arrival after slow ones would put its stamp before theirs.
    mapped_ns_ = std::max(stamp_ns + this->offset_ns(), mapped_ns_ + 1);
    return mapped_ns_;
  }

  /// One's own clock less the other, delay of the fastest arrival included; 0 before the first.
  std::int64_t offset_ns() const { return std::min(least_ns_, before_ns_); }

  /// The other clock was set, or began again.
  void clear() { *this = {}; }

 private:
  bool is_begun_ = false;
  std::int64_t begin_ns_ = 0;   // of the window
  std::int64_t least_ns_ = 0;   // offset, in the window
  std::int64_t before_ns_ = 0;  // in the one before
  std::int64_t mapped_ns_ = 0;  // the newest stamp that was given out
};

}  // namespace ardrone_vslam
