// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "landmarks/point_world.hpp"
#include "trajectory/trajectory.hpp"

namespace ardrone_vslam {

/// Landmarks beside a path, as house fronts, poles and kerbs are beside a street.
struct StreetConfig {
  int landmarks = 45000;
  double nearest_m = 4;  ///< to the left or right of the path
  double farthest_m = 15;
  double lowest_m = -1.6;  ///< above the camera's height on the path
  double highest_m = 6;
};

/// Spreads landmarks evenly over the path's length. @pre path of two poses or more
void addStreet(PointWorld& world, const Trajectory& path, const StreetConfig& config,
               std::uint64_t seed);

/// KITTI's left grey camera (sequences 00 to 02), which sees such landmarks 40 m away.
PointCamera streetCamera();

/// A file of poses: KITTI's 12 numbers a line (T_cam0_cam; stamps of times.txt beside it, else 10 a
/// second), or TUM's 8 (T_map_base). @throws std::runtime_error naming file and fault
Trajectory readPath(const std::string& path);

}  // namespace ardrone_vslam
