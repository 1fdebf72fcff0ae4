// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "ardrone_vslam/parameters.hpp"
#include "ardrone_vslam/window_state.hpp"

namespace ardrone_vslam {

/// How well heights above the floor are known, and which of them count.
struct HeightConfig {
  double height_deviation_m = 0.03;
  double height_interval_s = 0.5;
  double height_gate_deviations = 3;
  double floor_step_s = 1;
  bool floor_points = false;
  double floor_point_deviation_m = 0.1;
};

template <class Visitor>
void visitParameters(HeightConfig& c, Visitor&& visit) {
  visit(ParameterInfo{"height_deviation_m", "m", 0.0001, 10,
                      "constraint filter: deviation of a height above the floor"},
        c.height_deviation_m);
  visit(ParameterInfo{"height_interval_s", "s", 0, 1000,
                      "constraint filter: one height in so much time is used, as neighbours err "
                      "alike"},
        c.height_interval_s);
  visit(ParameterInfo{"height_gate_deviations", "-", 0.5, 1e6,
                      "constraint filter: a height that disagrees by more than this is rejected"},
        c.height_gate_deviations);
  visit(ParameterInfo{"floor_step_s", "s", 0, 1000,
                      "constraint filter: rejected heights that agree with each other for so long "
                      "are above another floor (a table)"},
        c.floor_step_s);
  visit(ParameterInfo{"floor_points", "switch", 0, 0,
                      "constraint filter: what a camera that looks down sees lies on the floor, as "
                      "far below as the height says (known_height_m, use_range or "
                      "use_navdata_height): its way tells the scale without any climb"},
        c.floor_points);
  visit(ParameterInfo{"floor_point_deviation_m", "m", 0.0001, 10,
                      "constraint filter: deviation of such a point from the floor, the height's "
                      "own error included"},
        c.floor_point_deviation_m);
}

/// What became of a frame's height.
enum class HeightOutcome {
  kNone,      ///< there was none, or the last one used is too young
  kApplied,   ///< corrects the pose, and the scale as the height changes
  kRejected,  ///< disagrees with the floor
  kNewFloor,  ///< the first one, or the floor is another one now: it tells where that is
};

/// Heights of base above a level floor whose own height is not known but for the heights
/// themselves. One height says nothing; their changes do, against the camera's motion of unknown
/// scale: this is what makes the scale visible. A floor that changes in steps (a table, stairs) is
/// begun anew; one that slopes along is taken for an error of scale.
class HeightUpdate {
 public:
  /// @throws ConfigError listing every parameter out of its range
  explicit HeightUpdate(const HeightConfig& config);

  /// Takes in the height at the newest frame. O(coordinates^2).
  HeightOutcome apply(double height_m, WindowState& state);

 private:
  bool agreesWithRejected(double floor_map_m) const;

  HeightConfig config_;
  bool has_floor_ = false;
  std::int64_t used_ns_ = 0;  // stamp of the last height looked at
  // Since when heights were rejected, and the floor that the last of them told of.
  bool is_rejecting_ = false;
  std::int64_t rejecting_since_ns_ = 0;
  double rejected_floor_map_m_ = 0;
};

}  // namespace ardrone_vslam
