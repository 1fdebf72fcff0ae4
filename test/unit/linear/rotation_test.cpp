// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ardrone_vslam {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();

TEST(Rotation, IsEigensOfItsVector) {
  for (const double angle_rad : {0.0, 1e-17, 1e-9, 0.3, 1.6, 3.1}) {
    const Eigen::Matrix3d R = rotationOf(angle_rad * kAxis);
    EXPECT_LT((R - Eigen::AngleAxisd(angle_rad, kAxis).toRotationMatrix()).norm(), 1e-15)
        << angle_rad;
    EXPECT_LT((rotationVectorOf(R) - angle_rad * kAxis).norm(), 1e-15) << angle_rad;
    EXPECT_NEAR(angleOf_rad(R), angle_rad, 1e-15);
  }
}

TEST(Rotation, AboutZHasThatYaw) {
  for (const double yaw_rad : {-3.0, -0.2, 0.0, 1.0, 2.5}) {
    EXPECT_NEAR(yawOf(rotationAboutZ(yaw_rad)), yaw_rad, 1e-15);
    EXPECT_LT((rotationAboutZ(yaw_rad) - rotationOf({0, 0, yaw_rad})).norm(), 1e-15);
  }
}

TEST(Rotation, BetweenTwoIsPartOfTheWay) {
  const Eigen::Matrix3d A = rotationOf({0.4, 1, -0.2});
  const Eigen::Matrix3d B = A * rotationOf(0.8 * kAxis);
  EXPECT_EQ(rotationBetween(A, B, 0), A);
  EXPECT_LT((rotationBetween(A, B, 0.25) - A * rotationOf(0.2 * kAxis)).norm(), 1e-15);
  EXPECT_LT((rotationBetween(A, B, 1) - B).norm(), 1e-15);
  EXPECT_EQ(rotationBetween(A, A, 0.7), A);
}

}  // namespace
}  // namespace ardrone_vslam
