// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

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

/// For what is worth a line each time, but may come with every message: five at once, and five a
/// second.
class EventLimiter {
 public:
  static constexpr double kMost = 5;

  /// @param now_s  any clock that ascends
  bool allows(double now_s) {
    left_ = std::min(kMost, left_ + kMost * (now_s - at_s_));
    at_s_ = now_s;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double left_ = kMost;
  double at_s_ = 0;
};

/// What a node and its parts warn of, through one limiter of each kind.
class Warnings {
 public:
  /// @param say  writes a sentence to the node's log
  explicit Warnings(std::function<void(const std::string&)> say) : say_(std::move(say)) {}

  /// Without limit: for what is said once, once a second, or as the answer to a call.
  void say(const std::string& sentence) const { say_(sentence); }
  /// A camera that changes, a clock that begins again: see EventLimiter.
  void event(const std::string& sentence) {
    if (allowsEvent()) say_(sentence);
  }
  /// Whether such a sentence may be said now, where it is no warning.
  bool allowsEvent() { return events_.allows(now_s()); }
  void limited(const std::string& sentence) { limited(sentence, sentence); }
  /// @param kind  by which it is limited, where the sentence has a number that changes
  void limited(const std::string& kind, const std::string& sentence) {
    if (limiter_.allows(kind, now_s())) say_(sentence);
  }
  /// Of a message that is not used.
  void refuse(const std::string& topic, const std::string& fault) {
    limited(topic + ": message not used: " + fault);
  }

 private:
  static double now_s() {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    return now.count();
  }

  std::function<void(const std::string&)> say_;
  WarningLimiter limiter_;
  EventLimiter events_;
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
