// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "driver_faults/message_pair.hpp"

namespace ardrone_vslam {

/// Tells poses that move on although the twist is zero.
class MissingTwistWatch {
 public:
  /// One message, in order. @param displacement_m  since the one before, by the poses
  /// @return whether a metre (again) was moved without a twist
  bool see(bool is_twist_zero, double displacement_m) {
    constexpr double kMost_m = 1;
    if (!is_twist_zero) {
      without_twist_m_ = 0;
    } else if (displacement_m < kJump_m) {
      without_twist_m_ += displacement_m;
    }
    if (without_twist_m_ < kMost_m) return false;
    without_twist_m_ = 0;
    return true;
  }

 private:
  double without_twist_m_ = 0;  // way of the poses since the twist has been zero
};

}  // namespace ardrone_vslam
