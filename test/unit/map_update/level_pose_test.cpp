// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/level_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Matrix3d turned(double heading_rad) {
  return Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

TEST(LevelPose, OneOfTheTwoIsTheTruthAndBothSeeThePointsAlongTheRays) {
  RandomSource random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double heading_rad = random.uniform(-M_PI, M_PI);
    const Eigen::Vector3d camera = 3 * random.normal3();
    const Eigen::Vector3d point_a = camera + 4 * random.normal3();
    const Eigen::Vector3d point_b = camera + 4 * random.normal3();
    const Eigen::Matrix3d R_level_map = turned(-heading_rad);
    const Eigen::Vector3d ray_a = R_level_map * (point_a - camera).normalized();
    const Eigen::Vector3d ray_b = R_level_map * (point_b - camera).normalized();
    const auto poses = posesOfPair(ray_a, point_a, ray_b, point_b);
    ASSERT_GE(poses.size(), 1U) << trial;
    ASSERT_LE(poses.size(), 2U) << trial;
    double nearest_m = 1e9;
    for (const LevelPose& pose : poses) {
      const Eigen::Matrix3d R = turned(pose.heading_rad);
      ASSERT_LT((R * ray_a - (point_a - pose.camera_map).normalized()).norm(), 1e-6) << trial;
      ASSERT_LT((R * ray_b - (point_b - pose.camera_map).normalized()).norm(), 1e-6) << trial;
      const double turn_m = std::abs(std::remainder(pose.heading_rad - heading_rad, 2 * M_PI));
      nearest_m = std::min(nearest_m, (pose.camera_map - camera).norm() + turn_m);
    }
    EXPECT_LT(nearest_m, 1e-6) << trial;
  }
}

TEST(LevelPose, NothingWhereHeightsSayNothing) {
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d aside = Eigen::Vector3d(1, 1, 0).normalized();
  EXPECT_TRUE(posesOfPair(ahead, {3, 0, 1}, aside, {3, 3, 1}).empty()) << "level rays";
  const Eigen::Vector3d up = Eigen::Vector3d(1, 0, 1).normalized();
  EXPECT_TRUE(posesOfPair(up, {3, 0, 2}, ahead, {3, 0, 1}).empty()) << "above each other";
}

}  // namespace
}  // namespace ardrone_vslam
