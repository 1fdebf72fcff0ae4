// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/watchdog.hpp"

#include <algorithm>
#include <utility>

#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

// Of the velocity's bias: a drone's odometry in a strong wind stays below.
constexpr double kMostBiasSigmas = 15;
constexpr double kMostNis = 8;          // of fixes: what follows from their covariance is 1
constexpr double kContradiction_s = 3;  // so long it must last: a person walks past in less
constexpr double kLongest_s = 1e6;      // of a pause

}  // namespace

bool Watchdog::see(std::int64_t stamp_ns, const Contradiction& contradiction) {
  constexpr double kCalmShare = 1.0 / 3;  // of a limit
  const double passed_s = last_ns_ ? seconds(stamp_ns - *last_ns_) : 0;
  last_ns_ = stamp_ns;

  const bool was_refused = std::exchange(is_refused_, !setup_.isCameraUsed());
  if (is_refused_) {
    bias_s_ = 0;
    fixes_s_ = 0;
    tracks_ = {};
    return !was_refused;
  }
  const double bias = contradiction.bias_sigmas / kMostBiasSigmas;
  bias_s_ = bias > 1 && !contradiction.is_camera_confirmed ? bias_s_ + passed_s : 0;
  // Images without old landmarks say nothing of fixes: the time with them counts.
  const double nis = contradiction.fix_nis.value_or(0) / kMostNis;
  if (contradiction.fix_nis) fixes_s_ = nis > 1 ? fixes_s_ + passed_s : 0;
  tracks_.see(stamp_ns, contradiction.tracks);
  calm_ = bias < kCalmShare && nis < kCalmShare && fixes_s_ == 0 && !tracks_.isDoubtful();
  if (std::max({bias_s_, fixes_s_, tracks_.lasted_s()}) < kContradiction_s) return false;
  bias_s_ = 0;
  fixes_s_ = 0;
  tracks_ = {};
  until_ns_ = stamp_ns + static_cast<std::int64_t>(pause_s_ * 1e9);
  pause_s_ = std::min(2 * pause_s_, kLongest_s);
  return true;
}

bool Watchdog::isDistrustful(std::int64_t stamp_ns) const {
  return is_refused_ || (until_ns_ && stamp_ns < *until_ns_);
}

}  // namespace ardrone_vslam
