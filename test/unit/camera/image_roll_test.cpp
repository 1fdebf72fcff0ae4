// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "support/point_world.hpp"

namespace ardrone_vslam {
namespace {

/// A forward camera on a drone of this attitude.
Eigen::Matrix3d camera(double yaw, double pitch, double roll) {
  const Eigen::Matrix3d R_odom_base = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                       Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                          .toRotationMatrix();
  return R_odom_base * test::forwardExtrinsics().linear();
}

TEST(ImageRoll, IsMinusTheRollOfAForwardCamera) {
  for (const double yaw : {-2.0, 0.0, 1.0}) {
    for (const double roll : {-3.0, -0.4, 0.0, 0.1, 1.5})
      EXPECT_NEAR(imageRoll_rad(camera(yaw, 0, roll)).value(), -roll, 1e-6);
  }
}

TEST(ImageRoll, AVerticalLineAppearsAlongIt) {
  const Eigen::Matrix3d R_odom_cam = camera(0.7, 0.5, -0.3);
  const auto pixelOf = [&](double height) -> Eigen::Vector2d {
    const Eigen::Vector3d ahead = R_odom_cam.col(2);
    const Eigen::Vector3d p =
        R_odom_cam.transpose() * (5 * ahead + height * Eigen::Vector3d::UnitZ());
    return p.head<2>() / p.z();
  };
  const Eigen::Vector2d down = pixelOf(-1e-4) - pixelOf(1e-4);
  const double turn = imageRoll_rad(R_odom_cam).value();
  const Eigen::Vector2d turned_y(-std::sin(turn), std::cos(turn));
  EXPECT_NEAR(turned_y.dot(down.normalized()), 1, 1e-6);
}

TEST(ImageRoll, NoneLookingStraightUpOrDown) {
  for (const double pitch : {1.4, M_PI / 2, -M_PI / 2, -1.4})
    EXPECT_FALSE(imageRoll_rad(camera(0.3, pitch, 0.2))) << pitch;
  EXPECT_TRUE(imageRoll_rad(camera(0.3, 1.2, 0.2)));
}

}  // namespace
}  // namespace ardrone_vslam
