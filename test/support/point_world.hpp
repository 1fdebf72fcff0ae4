// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "landmarks/point_world.hpp"

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

/// A camera that looks down, as the AR.Drone's bottom one.
inline Eigen::Isometry3d bottomExtrinsics() {
  Eigen::Isometry3d T_base_cam = Eigen::Isometry3d::Identity();
  T_base_cam.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  return Eigen::Translation3d(0, -0.02, 0) * T_base_cam;
}

/// 10 m by 8 m, 3 m high, 1200 points on its walls.
inline PointWorld pointRoom(std::uint64_t seed, const ViewFaults& faults = {}) {
  PointWorld world(seed, faults);
  world.addRoom({10, 8, 3}, 1200);
  return world;
}
inline PointWorld pointRoom(std::uint64_t seed, double wrong_share) {
  ViewFaults faults;
  faults.wrong_share = wrong_share;
  return pointRoom(seed, faults);
}

/// A room with a cupboard before one of its walls: rooms of one seed have the same one.
inline PointWorld roomWithCupboard(std::uint64_t seed, bool is_other_room) {
  constexpr int kPoints = 80;
  ViewFaults faults;
  faults.wrong_share = 0.1;
  PointWorld world(seed, faults);
  RandomSource random(seed, 9);
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d corner(random.uniform(-0.3, 0.3), random.uniform(-0.6, 0.6),
                                 random.uniform(0, 2));
    world.addPoint(corner + Eigen::Vector3d(4.5, 0, 0));
  }
  if (is_other_room) {
    world.transform(Eigen::Isometry3d(Eigen::AngleAxisd(2, Eigen::Vector3d::UnitZ())));
    world.randomDescriptor();  // what follows is drawn otherwise
  }
  world.addRoom({10, 8, 3}, 1200);
  return world;
}

/// Of PointWorld's camera where a test gives no other.
constexpr double kPointFocalLength_px = 570;

}  // namespace ardrone_vslam::test
