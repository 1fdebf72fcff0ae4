// SPDX-License-Identifier: BSD-3-Clause
#include "pave/pave_stamps.hpp"

#include <algorithm>
#include <iterator>

#include "trajectory/ascent.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kPerMillisecond_ns = 1'000'000;
constexpr std::int64_t kRestart_ns = 1'000'000'000;  // further back is no damage
constexpr std::int64_t kRestartGap_ns = 1'000'000'000;
constexpr std::int64_t kNominal_ns = 33'333'333;  // the drone's 30 frames a second
constexpr std::int64_t kShortest_ns = 5'000'000;
constexpr std::int64_t kLongest_ns = 200'000'000;
constexpr std::size_t kAround = 15;          // frames that tell what time it was: a group
constexpr std::size_t kFewest = 3;           // of them
constexpr std::uint32_t kMostSkipped = 300;  // frame numbers between two frames; 10 s

using Stamps = std::vector<std::int64_t>;

std::int64_t medianOf(Stamps::const_iterator begin, Stamps::const_iterator end) {
  Stamps stamps(begin, end);
  const auto middle = stamps.begin() + static_cast<std::ptrdiff_t>(stamps.size() / 2);
  std::nth_element(stamps.begin(), middle, stamps.end());
  return *middle;
}

/// Whether the clock begins anew at a frame: it goes back there, and what follows is earlier than
/// what was before, but for single damaged stamps. @param begin  of the run so far
bool isRestart(const Stamps& stamps_ns, std::size_t begin, std::size_t at) {
  if (stamps_ns[at] >= stamps_ns[at - 1]) return false;
  const std::size_t end = std::min(at + kAround, stamps_ns.size());
  begin = std::max(begin, at - std::min(at, kAround));
  if (at - begin < kFewest || end - at < kFewest) return false;
  const auto iterator = [&stamps_ns](std::size_t i) {
    return stamps_ns.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return medianOf(iterator(at), iterator(end)) <
         medianOf(iterator(begin), iterator(at)) - kRestart_ns;
}

/// Frame numbers from one frame to the next, at least 1 where they do not ascend.
std::int64_t numbersBetween(const PaveHeader& a, const PaveHeader& b) {
  const bool ascends = b.frame_number > a.frame_number;
  const std::uint32_t between = ascends ? b.frame_number - a.frame_number : 1;
  return between <= kMostSkipped ? between : 1;
}

/// A run without restart; its stamps begin wherever they do.
class PaveRun {
 public:
  PaveRun(const std::vector<PaveHeader>& headers, const Stamps& stamps_ns, std::size_t begin,
          std::size_t end)
      : begin_(begin) {
    const Stamps told_ns(stamps_ns.begin() + static_cast<std::ptrdiff_t>(begin),
                         stamps_ns.begin() + static_cast<std::ptrdiff_t>(end));
    frames_ = longestAscent(told_ns, Ascent::kStrict);
    is_spread_ = 2 * frames_.size() <= told_ns.size();
    if (is_spread_) {
      spread(headers, told_ns);
    } else {
      for (const std::size_t frame : frames_) stamps_ns_.push_back(told_ns[frame]);
    }
    dropped_ = told_ns.size() - frames_.size();
  }

  void appendTo(PaveStamps& all) const {
    const std::int64_t offset_ns =
        all.stamps_ns.empty() ? 0 : all.stamps_ns.back() + kRestartGap_ns - stamps_ns_.front();
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      all.frames.push_back(begin_ + frames_[i]);
      all.stamps_ns.push_back(stamps_ns_[i] + offset_ns);
    }
    all.spread_frames += is_spread_ ? frames_.size() : 0;
    all.dropped_frames += dropped_;
  }

 private:
  void spread(const std::vector<PaveHeader>& headers, const Stamps& told_ns) {
    const std::int64_t first_ns = told_ns[frames_.front()];
    const std::int64_t told_span_ns = told_ns[frames_.back()] - first_ns;
    std::vector<std::int64_t> numbers{0};
    frames_.assign(1, 0);
    for (std::size_t i = 1; i < told_ns.size(); ++i) {
      frames_.push_back(i);
      numbers.push_back(numbers.back() +
                        numbersBetween(headers[begin_ + i - 1], headers[begin_ + i]));
    }
    std::int64_t interval_ns = told_span_ns / numbers.back();
    if (interval_ns < kShortest_ns || interval_ns > kLongest_ns) interval_ns = kNominal_ns;
    for (const std::int64_t number : numbers) stamps_ns_.push_back(first_ns + number * interval_ns);
  }

  std::size_t begin_;
  std::vector<std::size_t> frames_;  // counted from begin_
  Stamps stamps_ns_;
  bool is_spread_ = false;
  std::size_t dropped_ = 0;
};

}  // namespace

PaveStamps stampsOf(const std::vector<PaveHeader>& headers) {
  Stamps stamps_ns;
  for (const PaveHeader& header : headers)
    stamps_ns.push_back(kPerMillisecond_ns * header.timestamp_ms);
  PaveStamps all;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    if (!isRestart(stamps_ns, begin, i)) continue;
    PaveRun(headers, stamps_ns, begin, i).appendTo(all);
    ++all.restarts;
    begin = i;
  }
  if (begin < stamps_ns.size()) PaveRun(headers, stamps_ns, begin, stamps_ns.size()).appendTo(all);
  return all;
}

}  // namespace ardrone_vslam
