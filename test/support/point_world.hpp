// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "../../tools/lib/point_world.hpp"

namespace ardrone_vslam::test {

using ardrone_vslam::PointWorld;
using ardrone_vslam::ViewFaults;
using ardrone_vslam::WorldPoint;

/// A forward camera's optical frame at the base (REP-103 to x right, y down, z forward).
inline Eigen::Isometry3d forwardExtrinsics() {
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  T_base_cam.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_base_cam;
}

/// Of PointWorld's camera where a test gives no other.
constexpr double kPointFocalLength_px = 570;

}  // namespace ardrone_vslam::test
