// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace ardrone_vslam {

inline double squared(double value) {
  return value * value;
}

inline double seconds(std::int64_t duration_ns) {
  return static_cast<double>(duration_ns) * 1e-9;
}

inline double radians(double degrees) {
  return degrees * M_PI / 180;
}

/// What takes a vector's part across a unit vector.
inline Eigen::Matrix3d acrossOf(const Eigen::Vector3d& unit) {
  return Eigen::Matrix3d::Identity() - unit * unit.transpose();
}

}  // namespace ardrone_vslam
