// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// Tells ascending stamps from late messages and from a clock that began again (a bag that loops).
class StampGuard {
 public:
  enum class Answer {
    kAscending,  ///< the first one, or after the one before
    kNotAfter,   ///< equal to the newest stamp or up to `kRestart_ns` before it: to be dropped
    kRestart     ///< further back: time began again, the stamp is the first of a new run
  };
  static constexpr std::int64_t kRestart_ns = 1'000'000'000;

  Answer check(std::int64_t stamp_ns) {
    const bool is_first = newest_ns_ == 0;
    if (!is_first && stamp_ns <= newest_ns_ && stamp_ns > newest_ns_ - kRestart_ns) {
      return Answer::kNotAfter;
    }
    const bool is_restart = !is_first && stamp_ns <= newest_ns_;
    newest_ns_ = stamp_ns;
    return is_restart ? Answer::kRestart : Answer::kAscending;
  }

 private:
  std::int64_t newest_ns_ = 0;  // stamps of zero are refused before they come here
};

/// Counts messages that were lost between two nodes, by the gaps in their sequence numbers.
class GapCounter {
 public:
  void see(std::uint32_t sequence) {
    if (newest_ != 0 && sequence > newest_) lost_ += sequence - newest_ - 1;
    newest_ = sequence;  // a smaller one: the sender began again
  }
  std::uint64_t lost() const { return lost_; }

 private:
  std::uint32_t newest_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace ardrone_vslam
