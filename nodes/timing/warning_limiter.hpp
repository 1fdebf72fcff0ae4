// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace ardrone_vslam {

/// Keeps a fault that comes with every message from flooding the log, without hiding a second one
/// behind it: the same sentence every 5 s, another one at once (but five a second at most).
class WarningLimiter {
 public:
  static constexpr double kSame_s = 5.0;
  static constexpr double kOther_s = 0.2;

  /// @param now_s  any clock that ascends
  bool allows(const std::string& sentence, double now_s) {
    const double wait_s = sentence == last_ ? kSame_s : kOther_s;
    if (!last_.empty() && now_s - at_s_ < wait_s) return false;
    last_ = sentence;
    at_s_ = now_s;
    return true;
  }

 private:
  std::string last_;
  double at_s_ = 0;
};

/// Whether to say again what one waits for: after 3 s (drivers need their time to start), then
/// every 30 s.
inline bool isReminderDue(int seconds_waiting) {
  constexpr int kPatience_s = 3;
  constexpr int kPeriod_s = 30;
  return seconds_waiting == kPatience_s ||
         (seconds_waiting > 0 && seconds_waiting % kPeriod_s == 0);
}

}  // namespace ardrone_vslam
