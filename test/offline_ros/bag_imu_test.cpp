// SPDX-License-Identifier: BSD-3-Clause
// Bags whose odometry gets its attitude from an IMU (odometry_mode imu).
#include <gtest/gtest.h>
#include <sensor_msgs/Imu.h>

#include "bag_recipe.hpp"

namespace ardrone_vslam {
namespace {

const Eigen::Quaterniond kMounted(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));  // head down

sensor_msgs::Imu imuAt(double stamp_s, double heading_deg) {
  const Eigen::Quaterniond R_world_imu =
      Eigen::AngleAxisd(heading_deg * M_PI / 180, Eigen::Vector3d::UnitZ()) * kMounted;
  sensor_msgs::Imu message;
  message.header.stamp = ros::Time(stamp_s);
  message.header.frame_id = "/imu_link";
  message.orientation.x = R_world_imu.x();
  message.orientation.y = R_world_imu.y();
  message.orientation.z = R_world_imu.z();
  message.orientation.w = R_world_imu.w();
  return message;
}

/// A left turn by 90 degrees at 1.05 s, of which the odometry knows nothing.
std::vector<sensor_msgs::Imu> turnLeft() {
  std::vector<sensor_msgs::Imu> messages;
  for (int i = 0; i <= 55; ++i) messages.push_back(imuAt(0.95 + 0.01 * i, i <= 10 ? 30 : 120));
  return messages;
}

struct ImuBag {
  BagRecipe recipe;
  std::vector<sensor_msgs::Imu> imu = turnLeft();
  bool has_mounting = true;

  TestBag write() const {
    return TestBag(recipe, [this](rosbag::Bag& bag) {
      ros::Time now(1.0);
      for (const auto& message : imu) bag.write("/imu/data", now += ros::Duration(0.01), message);
      Eigen::Isometry3d T_base_imu(kMounted);
      tf2_msgs::TFMessage tf;
      tf.transforms = {toTransformMessage(T_base_imu, ros::Time(1.0), "base", "imu_link")};
      if (has_mounting) bag.write("/tf_static", ros::Time(1.0), tf);
    });
  }
};

BagReadOptions withImu() {
  BagReadOptions options;
  options.odometry_mode = OdometryMode::kImu;
  return options;
}

TEST(BagImu, DisplacementsAreLaidAlongItsAttitude) {
  const TestBag bag = ImuBag().write();
  const auto sequence = bag.open(withImu());
  ASSERT_EQ(sequence->odometry().size(), 5U);
  EXPECT_TRUE(sequence->findings().warnings.empty());
  EXPECT_TRUE(sequence->odometry()[0].T_odom_base.isApprox(Eigen::Isometry3d::Identity(), 1e-9))
      << "it begins where the odometry does";
  const Eigen::Isometry3d& last = sequence->odometry()[4].T_odom_base;
  // Half a step along each of the two directions, then three steps to the left.
  EXPECT_LT((last.translation() - Eigen::Vector3d(0.25, 0.25 + 1.5, 0)).norm(), 1e-9);
  EXPECT_LT((last.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_EQ(sequence->odometry()[4].covariance(0, 0), 0.25);
}

TEST(BagImu, WhatIsMissingIsNamed) {
  ImuBag without;
  without.imu.clear();
  without.write().expectRefused({"no topic for the IMU", "odometry_mode to pose"}, withImu());
  ImuBag unmounted;
  unmounted.has_mounting = false;
  unmounted.write().expectRefused({"'base' to the IMU frame 'imu_link'"}, withImu());
}

TEST(BagImu, MessagesOfNoUseAreDroppedAndCounted) {
  ImuBag bag;
  bag.imu[3].orientation_covariance[0] = -1;
  bag.imu[4].header.stamp = ros::Time(500.0);
  bag.imu.erase(bag.imu.begin() + 20, bag.imu.begin() + 50);  // 1.15 s to 1.45 s
  const TestBag file = bag.write();
  const auto sequence = file.open(withImu());
  EXPECT_EQ(sequence->odometry().size(), 2U);
  const BagFindings& findings = sequence->findings();
  ASSERT_EQ(findings.warnings.size(), 3U);
  EXPECT_NE(findings.warnings[0].find("/imu/data: 1 messages dropped (the first: it has no "
                                      "orientation"),
            std::string::npos);
  EXPECT_NE(findings.warnings[1].find("1 messages dropped: stamps must ascend"), std::string::npos);
  EXPECT_NE(findings.warnings[2].find("3 odometry messages dropped: no attitude"),
            std::string::npos);
  EXPECT_TRUE(findings.has_lost_much);
}

TEST(BagImu, AWorldWhoseZPointsDownIsNamed) {
  ImuBag bag;
  for (sensor_msgs::Imu& message : bag.imu) {  // turned by 180 degrees about the world's x
    const geometry_msgs::Quaternion q = message.orientation;
    message.orientation.x = q.w;
    message.orientation.y = -q.z;
    message.orientation.z = q.y;
    message.orientation.w = -q.x;
  }
  const TestBag file = bag.write();
  const auto sequence = file.open(withImu());
  EXPECT_TRUE(sequence->odometry().empty());
  ASSERT_EQ(sequence->findings().warnings.size(), 1U);
  EXPECT_NE(sequence->findings().warnings[0].find("not north-east-down"), std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam
