// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// Tells ascending stamps from late messages, from single ones with a wrong stamp, and from a clock
/// that began again (a bag that loops).
class StampGuard {
 public:
  enum class Answer {
    kAscending,  ///< the first one, or after the one before
    kNotAfter,   ///< equal to the newest stamp or up to `kRestart_ns` before it: to be dropped
    kAlone,      ///< further back, or far ahead, and no others say so: to be dropped
    kRestart     ///< further back, as others before: time began again, the first of a new run
  };
  static constexpr std::int64_t kRestart_ns = 1'000'000'000;
  static constexpr std::int64_t kFarAhead_ns = 3'000'000'000;
  /// So many stamps one after the other are no mistake.
  static constexpr int kAgreeing = 3;

  Answer check(std::int64_t stamp_ns) {
    const bool is_first = newest_ns_ == 0;
    const std::int64_t step_ns = stamp_ns - newest_ns_;
    if (is_first || (step_ns > 0 && step_ns <= kFarAhead_ns)) {
      newest_ns_ = stamp_ns;
      alone_ = 0;
      return Answer::kAscending;
    }
    if (step_ns <= 0 && step_ns > -kRestart_ns) return Answer::kNotAfter;
    if (!agrees(stamp_ns)) return Answer::kAlone;
    newest_ns_ = stamp_ns;
    alone_ = 0;
    return step_ns < 0 ? Answer::kRestart : Answer::kAscending;
  }

 private:
  /// Whether enough stamps have gone on from each other, this one included.
  bool agrees(std::int64_t stamp_ns) {
    const std::int64_t step_ns = stamp_ns - alone_ns_;
    if (alone_ > 0 && step_ns <= 0 && step_ns > -kRestart_ns) return false;  // late, or a burst
    alone_ = alone_ > 0 && step_ns > 0 ? alone_ + 1 : 1;
    alone_ns_ = stamp_ns;
    return alone_ >= kAgreeing;
  }

  std::int64_t newest_ns_ = 0;  // stamps of zero are refused before they come here
  std::int64_t alone_ns_ = 0;   // the newest of those that agree on another time
  int alone_ = 0;               // how many they are
};

/// Why a message with StampGuard::Answer::kAlone is not used.
constexpr const char* kAloneFault =
    "its stamp is far from those of all other messages; three that agree begin a new run";

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
