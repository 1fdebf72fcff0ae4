// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam {

/// Tells heights in whole metres (a driver that divides integers) from a height that is constant.
class WholeMetresWatch {
 public:
  /// One height, in order. @param climb_m  since the one before, by the twist
  /// @return whether it is a step of whole metres after others
  bool see(double height_m, double climb_m);
  /// Whether all heights of late were whole metres although the twist climbs.
  bool isWhole() const { return is_whole_; }

 private:
  static constexpr int kFewest = 10;

  int count_ = 0;  // whole ones on end
  double last_m_ = 0;
  double climbed_m_ = 0;  // by the twist, since the last step
  bool is_whole_ = false;
};

/// The height by the twist, drawn slowly into the metre that was cut off from the one reported.
/// @param foreseen_m  the last answer, moved by the twist. @param dt_s  since then
double smoothedHeight_m(double reported_m, double foreseen_m, double dt_s);

}  // namespace ardrone_vslam
