// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// Tells new datagrams from late ones, and from those of a sender that was started again.
class SequenceGuard {
 public:
  enum class Answer {
    kNew,     ///< the first, or newer than all before
    kLate,    ///< overtaken, or there twice: to be dropped
    kRestart  ///< the sender counts from the beginning again
  };
  /// A number further back is no late one.
  static constexpr std::int32_t kLatest = 100;
  /// After so long without a new one any number is new.
  static constexpr std::int64_t kForget_ns = 1'000'000'000;

  /// @param now_ns  of a clock that does not go back
  Answer check(std::uint32_t sequence, std::int64_t now_ns) {
    const auto step = static_cast<std::int32_t>(sequence - newest_);  // numbers wrap around
    const bool is_first = !has_heard_;
    if (!is_first && step <= 0 && step > -kLatest && now_ns - heard_ns_ < kForget_ns)
      return Answer::kLate;
    if (!is_first && step > 0) lost_ += static_cast<std::uint32_t>(step) - 1;
    has_heard_ = true;
    newest_ = sequence;
    heard_ns_ = now_ns;
    return is_first || step > 0 ? Answer::kNew : Answer::kRestart;
  }

  /// The sender began again: its next number is the first. What was lost stays counted.
  void restart() { has_heard_ = false; }

  /// Numbers left out so far; those that came late are among them.
  std::uint64_t lost() const { return lost_; }

 private:
  bool has_heard_ = false;
  std::uint32_t newest_ = 0;
  std::int64_t heard_ns_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace ardrone_vslam
