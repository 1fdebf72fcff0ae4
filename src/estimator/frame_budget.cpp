// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/frame_budget.hpp"

#include <algorithm>
#include <utility>

namespace ardrone_vslam {
namespace {

constexpr double kKept = 0.95;     // of what a work is expected to take, from image to image
constexpr double kReserve = 0.99;  // and of the time that is asked for, after each refusal

}  // namespace

void FrameBudget::begin(const FrameClock& clock) {
  clock_ = budget_ms_ > 0 ? clock : FrameClock();
  left_out_.reset();
  for (Cost& cost : costs_) {
    cost.began_ms.reset();
    cost.has_shrunk = false;
  }
}

bool FrameBudget::take(OptionalWork work) {
  if (!clock_) return true;
  const auto index = static_cast<std::size_t>(work);
  const double now_ms = clock_();
  double needed_ms = 0;
  for (std::size_t i = index; i < costs_.size(); ++i) needed_ms += costs_[i].expected_ms;
  if (now_ms + costs_[index].reserve * needed_ms > budget_ms_) {
    costs_[index].reserve *= kReserve;
    // Those that count more, too: they may not be due for long.
    for (std::size_t i = index; i < costs_.size(); ++i) {
      if (!std::exchange(costs_[i].has_shrunk, true)) costs_[i].expected_ms *= kKept;
    }
    left_out_.set(index);
    return false;
  }
  costs_[index].began_ms = now_ms;
  costs_[index].reserve = 1;
  return true;
}

void FrameBudget::done(OptionalWork work) {
  Cost& cost = costs_[static_cast<std::size_t>(work)];
  if (!clock_ || !cost.began_ms) return;
  cost.expected_ms = std::max(clock_() - *cost.began_ms, kKept * cost.expected_ms);
  cost.began_ms.reset();
}

}  // namespace ardrone_vslam
