// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/watchdog.hpp"

#include <algorithm>

namespace ardrone_vslam {
namespace {

constexpr double kLongest_s = 1e6;  // of a pause

}  // namespace

Watchdog::Watchdog(const WatchdogConfig& config)
    : config_(config), pause_s_(config.watchdog_pause_s) {
  validate(config);
}

bool Watchdog::see(std::int64_t stamp_ns, const Contradiction& contradiction) {
  constexpr double kCalmShare = 1.0 / 3;  // of a limit
  const double passed_s = last_ns_ ? static_cast<double>(stamp_ns - *last_ns_) * 1e-9 : 0;
  last_ns_ = stamp_ns;

  const double bias = contradiction.bias_sigmas / config_.watchdog_sigmas;
  bias_s_ = bias > 1 && !contradiction.is_confirmed ? bias_s_ + passed_s : 0;
  // Images without old landmarks say nothing of fixes: the time with them counts.
  const double nis = contradiction.fix_nis.value_or(0) / config_.watchdog_nis;
  if (contradiction.fix_nis) fixes_s_ = nis > 1 ? fixes_s_ + passed_s : 0;
  calm_ = bias < kCalmShare && nis < kCalmShare && fixes_s_ == 0;
  if (bias_s_ < config_.watchdog_s && fixes_s_ < config_.watchdog_s) return false;
  bias_s_ = 0;
  fixes_s_ = 0;
  until_ns_ = stamp_ns + static_cast<std::int64_t>(pause_s_ * 1e9);
  pause_s_ = std::min(2 * pause_s_, kLongest_s);
  return true;
}

bool Watchdog::isDistrustful(std::int64_t stamp_ns) const {
  return until_ns_ && stamp_ns < *until_ns_;
}

}  // namespace ardrone_vslam
