// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
const Frames kCorrectedFrames{"map", "odom", "base_link"};

FrameResult correctedResult() {
  FrameResult result;
  result.stamp_ns = 5'000'000'007;
  result.T_map_base.translation() << 1, 2, 3;
  result.T_map_base.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()));
  result.T_odom_base.translation() << 4, 5, 6;
  result.T_odom_base.rotate(Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitY()));
  result.covariance = 0.5 * Matrix6d::Identity();
  result.covariance(0, 5) = result.covariance(5, 0) = 0.1;
  return result;
}

PoseCorrection goodCorrection() {
  const FrameResult result = correctedResult();
  return toCorrectionMessage(result, result.T_map_base * result.T_odom_base.inverse(),
                             kCorrectedFrames);
}

TEST(LateCorrectionConversion, RoundTrip) {
  const auto checked = toLateCorrection(goodCorrection());
  ASSERT_TRUE(checked.value) << checked.fault;
  const FrameResult result = correctedResult();
  EXPECT_EQ(checked.value->stamp_ns, result.stamp_ns);
  EXPECT_TRUE(checked.value->T_map_base.isApprox(result.T_map_base, 1e-12));
  EXPECT_TRUE(checked.value->T_odom_base.isApprox(result.T_odom_base, 1e-12));
  EXPECT_EQ(checked.value->covariance, result.covariance);
}

TEST(LateCorrectionConversion, FaultsAreNamed) {
  const auto faultAfter = [](const std::function<void(PoseCorrection&)>& change) {
    PoseCorrection message = goodCorrection();
    change(message);
    const auto checked = toLateCorrection(message);
    EXPECT_NE(checked.value.has_value(), !checked.fault.empty());
    return checked.fault;
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(faultAfter([](auto&) {}), "");
  EXPECT_TRUE(contains(faultAfter([](auto& m) { m.header.stamp = ros::Time(); }), "stamp is zero"));
  EXPECT_TRUE(contains(faultAfter([](auto& m) { m.observer_pose.position.x = kNoNumber; }),
                       "observer_pose: its position is not finite"));
  EXPECT_TRUE(contains(faultAfter([](auto& m) { m.fused_pose.pose.orientation.w = kNoNumber; }),
                       "fused_pose: its orientation is not finite"));
  EXPECT_TRUE(contains(
      faultAfter([](auto& m) { m.observer_pose.orientation = geometry_msgs::Quaternion(); }),
      "observer_pose: its orientation has norm 0"));
  EXPECT_TRUE(
      contains(faultAfter([](auto& m) { m.fused_pose.covariance[3] = kNoNumber; }), "not finite"));
  EXPECT_TRUE(contains(faultAfter([](auto& m) { m.fused_pose.covariance[0] = -1; }),
                       "not symmetric or not positive"));
  EXPECT_TRUE(
      contains(faultAfter([](auto& m) { m.fused_pose.pose.position.z = 2e7; }), "beyond 1e+07 m"));
}

TEST(MapStateConversion, Odometry) {
  MapState state;
  state.stamp_ns = 5'000'000'007;
  state.T_map_base = correctedResult().T_map_base;
  state.covariance = correctedResult().covariance;
  state.twist_base << 0.7, 1, 2, 3, 4, 5;
  state.twist_covariance(1, 2) = 12;
  const auto message = toOdometryMessage(state, kCorrectedFrames);
  EXPECT_EQ(message.header.stamp, ros::Time(5, 7));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_EQ(message.pose, toPoseMessage(correctedResult(), kCorrectedFrames).pose);
  EXPECT_EQ(message.twist.twist.linear.x, 0.7);
  EXPECT_EQ(message.twist.twist.angular.z, 5);
  EXPECT_EQ(message.twist.covariance[8], 12) << "row-major";
}

}  // namespace
}  // namespace ardrone_vslam
