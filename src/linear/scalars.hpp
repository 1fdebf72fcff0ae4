// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace ardrone_vslam {

inline double squared(double value) {
  return value * value;
}

inline double radians(double degrees) {
  return degrees * M_PI / 180;
}

}  // namespace ardrone_vslam
