// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "ardrone_vslam/frame_result.hpp"
#include "ardrone_vslam/msckf_config.hpp"
#include "window/window_state.hpp"

namespace ardrone_vslam {

/// Heights of base above a level floor whose own height is not known but for the heights
/// themselves. One height says nothing; their changes do, against the camera's motion of unknown
/// scale: this is what makes the scale visible. A floor that changes in steps (a table, stairs) is
/// begun anew; one that slopes along is taken for an error of scale.
class HeightUpdate {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit HeightUpdate(const HeightConfig& config);

  /// Takes in the height at the newest frame, if it has one. O(coordinates^2).
  void apply(WindowState& state);
  /// Of the newest frame.
  HeightOutcome outcome() const { return outcome_; }
  /// A height at the newest frame. O(coordinates^2).
  HeightOutcome apply(double height_m, WindowState& state);

 private:
  bool agreesWithRejected(double floor_map_m) const;

  HeightConfig config_;
  HeightOutcome outcome_ = HeightOutcome::kNone;
  bool has_floor_ = false;
  std::int64_t used_ns_ = 0;  // stamp of the last height looked at
  // Since when heights were rejected, and the floor that the last of them told of.
  bool is_rejecting_ = false;
  std::int64_t rejecting_since_ns_ = 0;
  double rejected_floor_map_m_ = 0;
};

}  // namespace ardrone_vslam
