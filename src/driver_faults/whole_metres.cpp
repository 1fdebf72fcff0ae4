// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/whole_metres.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {

bool WholeMetresWatch::see(double height_m, double climb_m) {
  constexpr double kClimb_m = 0.05;  // a twist that drifts at rest is told by the height
  if (height_m != std::round(height_m)) {
    *this = {};
    return false;
  }
  const bool is_step = count_ > 0 && height_m != last_m_;
  if (count_ < kFewest) ++count_;
  last_m_ = height_m;
  climbed_m_ = is_step ? 0 : climbed_m_ + climb_m;
  if (count_ < kFewest) return false;
  // At 0 it stands on the floor, whatever its twist says.
  if (is_step || (height_m != 0 && std::abs(climbed_m_) > kClimb_m)) is_whole_ = true;
  return is_step;
}

double smoothedHeight_m(double reported_m, double foreseen_m, double dt_s) {
  constexpr double kRate_m_s = 0.03;  // not faster than a twist is wrong, or the camera contradicts
  const double missing_m = std::clamp(foreseen_m, reported_m, reported_m + 1) - foreseen_m;
  return foreseen_m + std::clamp(missing_m, -kRate_m_s * dt_s, kRate_m_s * dt_s);
}

}  // namespace ardrone_vslam
