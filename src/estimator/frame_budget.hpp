// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "ardrone_vslam/stages.hpp"

namespace ardrone_vslam {

/// Says which optional work an image has time for. What a work takes is known from the images
/// before: the most of late. A work may begin if it and those that count more fit into what is left
/// of the budget. Each image that has no time for it takes a twentieth off what they are expected
/// to take, and asks for a hundredth less, so that each comes back now and then. Two works are not
/// bounded: one that was never done before, and one that takes longer than ever of late.
class FrameBudget {
 public:
  /// @param budget_ms  for a whole image; 0: without bound
  explicit FrameBudget(double budget_ms = 0) : budget_ms_(budget_ms) {}
  /// Another one, from the next begin() on.
  void limit(double budget_ms) { budget_ms_ = budget_ms; }

  /// A new image. @param clock  of this image, used until the next begin(); empty: without bound
  void begin(const FrameClock& clock);
  /// Whether the work may begin now; if so, done() is to follow.
  bool take(OptionalWork work);
  /// Does nothing if the work was not taken from this image's time.
  void done(OptionalWork work);
  bool hasLeftOut(OptionalWork work) const { return isLeftOut(work, left_out_); }
  /// What this image had no time for.
  const LeftOut& leftOut() const { return left_out_; }

 private:
  struct Cost {
    double expected_ms = 0;
    std::optional<double> began_ms;  // in this image
    bool has_shrunk = false;         // likewise
    double reserve = 1;              // less the longer it waits
  };

  double budget_ms_;
  FrameClock clock_;
  std::array<Cost, kOptionalWorkNames.size()> costs_;  // by OptionalWork
  LeftOut left_out_;
};

}  // namespace ardrone_vslam
