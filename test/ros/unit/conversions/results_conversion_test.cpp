// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <limits>
#include <vector>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

const Frames kFrames{"map", "odom", "base_link"};

FrameResult someResult() {
  FrameResult result;
  result.stamp_ns = 5'000'000'007;
  result.state = SlamState::kLocalised;
  result.T_map_base.translation() << 1, 2, 3;
  result.T_map_base.linear() =
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  result.T_odom_base.translation() << 4, 5, 6;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) result.covariance(row, column) = 10 * row + column;
  }
  result.sigma_m = 0.25;
  result.fix_nis = 1.5;
  result.track_nis = 1.25;
  result.velocity_bias_sigma_m_s = 0.04;
  result.yaw_walk_factor = 2.5;
  result.scale_error = -0.02;
  result.scale_sigma = 0.01;
  result.features = 100;
  result.match_method = MatchMethod::kIndexed;
  result.landmark_candidates = 30;
  result.landmark_matches = 20;
  result.feature_candidates = 40;
  result.feature_matches = 35;
  result.landmarks = 500;
  return result;
}

Eigen::Isometry3d fromPose(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  T_a_b.translation() << pose.position.x, pose.position.y, pose.position.z;
  T_a_b.linear() = Eigen::Quaterniond(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                      pose.orientation.z)
                       .toRotationMatrix();
  return T_a_b;
}

TEST(ResultConversion, Pose) {
  const FrameResult result = someResult();
  const auto message = toPoseMessage(result, kFrames);
  EXPECT_EQ(message.header.stamp, ros::Time(5, 7));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_TRUE(fromPose(message.pose.pose).isApprox(result.T_map_base, 1e-12));
  EXPECT_EQ(message.pose.covariance[1], 1);  // row-major
  EXPECT_EQ(message.pose.covariance[6], 10);
}

TEST(ResultConversion, OdometryCarriesTheTwistOfTheInput) {
  OdometryState odometry;
  odometry.twist_base << 0.7, 1, 2, 3, 4, 5;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column)
      odometry.twist_covariance(row, column) = 10 * row + column;
  }
  const auto message = toOdometryMessage(someResult(), kFrames, odometry);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.child_frame_id, "base_link");
  const auto& twist = message.twist.twist;
  EXPECT_EQ(twist.linear.x, 0.7);
  EXPECT_EQ(twist.linear.y, 1);
  EXPECT_EQ(twist.linear.z, 2);
  EXPECT_EQ(twist.angular.x, 3);
  EXPECT_EQ(twist.angular.y, 4);
  EXPECT_EQ(twist.angular.z, 5);
  EXPECT_EQ(message.twist.covariance[8], 12) << "row-major";
  EXPECT_EQ(message.pose, toPoseMessage(someResult(), kFrames).pose);
}

TEST(ResultConversion, Correction) {
  const FrameResult result = someResult();
  const Eigen::Isometry3d T_map_odom = result.T_map_base * result.T_odom_base.inverse();
  const auto message = toCorrectionMessage(result, T_map_odom, kFrames);
  EXPECT_TRUE(fromPose(message.observer_pose).isApprox(result.T_odom_base, 1e-12));
  EXPECT_TRUE(fromPose(message.fused_pose.pose).isApprox(result.T_map_base, 1e-12));
  EXPECT_EQ(message.map_to_odom.translation.x, T_map_odom.translation().x());
  EXPECT_EQ(message.deviation, 0.25);
  EXPECT_TRUE(message.corrected);
  FrameResult not_corrected = result;
  not_corrected.state = SlamState::kTooFewLandmarks;
  EXPECT_FALSE(toCorrectionMessage(not_corrected, T_map_odom, kFrames).corrected);
}

TEST(ResultConversion, StatusCountsWhatWasRemoved) {
  Status status;
  status.images = 77;
  toStatus(someResult(), "map", status);
  EXPECT_EQ(status.state, Status::LOCALISED);
  EXPECT_EQ(status.state_name, "localised");
  EXPECT_EQ(status.reason, "");
  EXPECT_EQ(status.landmark_mismatches, 10U);
  EXPECT_EQ(status.feature_mismatches, 5U);
  EXPECT_EQ(status.match_method, "indexed");
  EXPECT_EQ(status.images, 77U);
  EXPECT_EQ(status.fix_nis, 1.5);
  EXPECT_EQ(status.track_nis, 1.25);
  EXPECT_EQ(status.velocity_bias_deviation, 0.04);
  EXPECT_EQ(status.yaw_walk_factor, 2.5);
  EXPECT_EQ(status.scale_error, -0.02);
  EXPECT_EQ(status.scale_deviation, 0.01);
}

TEST(ResultConversion, StatusNamesAndCountsTheOdometrysFaults) {
  Status status;
  OdometryFaultCounts faults{};
  faults[static_cast<std::size_t>(OdometryFault::kBurst)] = 7;
  toStatus(faults, status);
  ASSERT_EQ(status.odometry_fault.size(), kOdometryFaultCount);
  ASSERT_EQ(status.odometry_fault_count.size(), kOdometryFaultCount);
  for (std::size_t i = 0; i < kOdometryFaultCount; ++i)
    EXPECT_EQ(status.odometry_fault_count[i], status.odometry_fault[i] == "burst" ? 7U : 0U) << i;
}

TEST(ResultConversion, StatusHasTheTimeOffsetInUseAndWhatItSeemsToBe) {
  Status status;
  status.image_time_offset_estimate = status.image_time_offset_deviation = 9;
  toStatus(TimeOffset{}, 0.25, status);
  EXPECT_EQ(status.image_time_offset, 0.25);
  EXPECT_EQ(status.image_time_offset_estimate, 0) << "not known";
  EXPECT_EQ(status.image_time_offset_deviation, 0);
  toStatus(TimeOffset{TimeOffsetState::kKnown, -0.0875, 0.003}, -0.1, status);
  EXPECT_EQ(status.image_time_offset, -0.1);
  EXPECT_EQ(status.image_time_offset_estimate, -0.0875);
  EXPECT_EQ(status.image_time_offset_deviation, 0.003);
}

TEST(ResultConversion, EveryOtherStateHasAReason) {
  const std::vector<std::pair<SlamState, std::uint8_t>> states{
      {SlamState::kBuildingMap, Status::BUILDING_MAP},
      {SlamState::kTooFewLandmarks, Status::TOO_FEW_LANDMARKS},
      {SlamState::kFixRejected, Status::FIX_REJECTED},
      {SlamState::kResting, Status::RESTING},
      {SlamState::kRotating, Status::ROTATING},
      {SlamState::kRelocated, Status::RELOCATED},
      {SlamState::kDistrusted, Status::DISTRUSTED},
      {SlamState::kSearchingMap, Status::SEARCHING_MAP},
      {SlamState::kBlind, Status::BLIND},
      {SlamState::kOdometryOnly, Status::OBSERVER_ONLY},
      {SlamState::kNotFinite, Status::NOT_FINITE}};
  for (const auto& [state, constant] : states) {
    FrameResult result = someResult();
    result.state = state;
    Status status;
    toStatus(result, "map", status);
    EXPECT_EQ(status.state, constant);
    EXPECT_NE(status.reason, "");
  }
}

TEST(ResultConversion, NearAPlainWallTheReasonIsTheImage) {
  for (const auto& [features, is_plain] : {std::pair(0, true), {7, true}, {8, false}}) {
    FrameResult result = someResult();
    result.state = SlamState::kTracking;
    result.features = features;
    Status status;
    toStatus(result, "map", status);
    EXPECT_EQ(status.reason.find("the image has hardly a corner") == 0, is_plain) << features;
  }
}

TEST(ResultConversion, TheStatusOfAResultThatIsNotFiniteIsFinite) {
  FrameResult result = someResult();
  result.state = SlamState::kNotFinite;
  result.sigma_m = std::numeric_limits<double>::quiet_NaN();
  Status status;
  toStatus(result, "map", status);
  EXPECT_EQ(status.state_name, "not_finite");
  EXPECT_EQ(status.deviation, 0);
}

std::vector<Landmark> someMap() {
  std::vector<Landmark> map;
  for (int i = 0; i < 5; ++i) {
    Landmark landmark;
    landmark.id = static_cast<std::uint32_t>(7 + i);
    landmark.position_map << i, 2 * i, -i;
    landmark.sigma_m = 0.01F + 0.3F * static_cast<float>(i);
    landmark.times_seen = 3 + i;
    map.push_back(landmark);
  }
  return map;
}

TEST(MapConversion, Cloud) {
  const std::vector<Landmark> map = someMap();
  const auto cloud = toCloud(map, "map", 9);
  ASSERT_EQ(cloud.width * cloud.height, map.size());
  sensor_msgs::PointCloud2ConstIterator<float> y(cloud, "y");
  sensor_msgs::PointCloud2ConstIterator<float> deviation(cloud, "deviation");
  sensor_msgs::PointCloud2ConstIterator<std::uint32_t> seen(cloud, "times_seen");
  sensor_msgs::PointCloud2ConstIterator<std::uint32_t> id(cloud, "id");
  for (const Landmark& landmark : map) {
    EXPECT_EQ(*y, static_cast<float>(landmark.position_map.y()));
    EXPECT_EQ(*deviation, static_cast<float>(landmark.sigma_m));
    EXPECT_EQ(*seen, static_cast<std::uint32_t>(landmark.times_seen));
    EXPECT_EQ(*id, landmark.id);
    ++y;
    ++deviation;
    ++seen;
    ++id;
  }
}

TEST(MapConversion, EmptyMap) {
  EXPECT_EQ(toCloud({}, "map", 9).width, 0U);
}

}  // namespace
}  // namespace ardrone_vslam
