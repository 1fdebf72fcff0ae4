// SPDX-License-Identifier: BSD-3-Clause
#include "conversions/onboard_conversion.hpp"

#include <gtest/gtest.h>

#include <set>

#include "conversions/conversions.hpp"
#include "support/intrinsics.hpp"

namespace ardrone_vslam {
namespace {

VslamPose somePose() {
  VslamPose pose{};
  pose.flags = VSLAM_POSE_IS_VALID;
  pose.state = VSLAM_TRACKING;
  pose.stamp_ns = 5;
  pose.frames_dropped = 7;
  pose.records_dropped = 8;
  pose.landmarks = 9;
  for (int axis = 0; axis < 3; ++axis) {
    pose.position_m[axis] = axis + 1;
    pose.observer_position_m[axis] = -axis;
  }
  pose.quaternion[3] = 1;
  pose.observer_quaternion[2] = 1;  // half a turn about z
  for (int i = 0; i < 6; ++i) pose.deviation[i] = 0.1 * (i + 1);
  return pose;
}

TEST(OnboardConversion, AnAnswerIsWhatTheMapperHad) {
  const FrameResult result = toFrameResult(somePose(), 42);
  EXPECT_EQ(result.stamp_ns, 42);
  EXPECT_EQ(result.state, SlamState::kTracking);
  EXPECT_TRUE(result.T_map_base.isApprox(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3))));
  EXPECT_TRUE(result.T_odom_base.translation().isApprox(Eigen::Vector3d(0, -1, -2)));
  EXPECT_TRUE(
      (result.T_odom_base.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitX()));
  for (int i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(result.covariance(i, i), 0.01 * (i + 1) * (i + 1));
  EXPECT_EQ(result.covariance.sum(), result.covariance.trace());
  EXPECT_NEAR(result.sigma_m, std::sqrt((0.01 + 0.04 + 0.09) / 3), 1e-12);
  EXPECT_EQ(result.landmarks, 9);
}

TEST(OnboardConversion, EveryStateOfTheCoreHasItsOwnNameAndSentence) {
  for (std::uint32_t state = 0; state <= VSLAM_LAST_STATE; ++state) {
    VslamPose pose = somePose();
    pose.state = state;
    Status status;
    toStatus(pose, status);
    FrameResult result;
    result.state = static_cast<SlamState>(state);
    result.features = 100;
    Status of_mapper;
    toStatus(result, "map", of_mapper);
    EXPECT_EQ(status.state, of_mapper.state);
    EXPECT_EQ(status.state_name, of_mapper.state_name);
    EXPECT_EQ(status.reason, of_mapper.reason);
  }
}

TEST(OnboardConversion, WhatAnImageWentWithoutIsSaidAsByTheMapper) {
  VslamPose pose = somePose();
  pose.flags |= VSLAM_POSE_WITHOUT_LANDMARKS | VSLAM_POSE_WITHOUT_KEYFRAME;
  EXPECT_EQ(toFrameResult(pose, 42).left_out, LeftOut("110"));
  Status status;
  toStatus(pose, status);
  EXPECT_EQ(status.reason.rfind(
                "frame_budget_ms leaves no time for all (left out: landmarks, keyframe)", 0),
            0U)
      << status.reason;
  EXPECT_EQ(status.reason.find("no place seen before"), std::string::npos) << "nobody looked";
}

TEST(OnboardConversion, AnswersWithoutAPoseSayWhy) {
  std::set<std::string> names;
  for (std::uint32_t state = VSLAM_WAITING_FOR_IMAGES; state <= VSLAM_OUT_OF_MEMORY; ++state) {
    VslamPose pose = somePose();
    pose.flags = 0;
    pose.state = state;
    Status status;
    status.dropped_bad_message = 3;  // the bridge's own
    toStatus(pose, status);
    EXPECT_FALSE(status.reason.empty());
    EXPECT_FALSE(isWell(status.state));
    names.insert(status.state_name);
    EXPECT_EQ(status.images_dropped, 7U);
    EXPECT_EQ(status.odometry_refused, 8U);
    EXPECT_EQ(status.landmarks, 9U);
    EXPECT_EQ(status.dropped_bad_message, 3U);
  }
  EXPECT_EQ(names.size(), 6U);
}

TEST(OnboardConversion, BearingsAreTheCalibrationsAndStrayFeaturesAreLeftOut) {
  const CameraModel camera(test::pinhole(320, 240, 300));
  ImageFeatures features;
  features.stamp_ns = 42;
  features.pixel_px = {{160.F, 120.F}, {400.F, 10.F}, {10.5F, 230.F}, {10.F, 300.F}};
  features.age_frames = {1, 2, 3, 4};
  EXPECT_EQ(addBearings(camera, features), 2U);
  ASSERT_EQ(features.size(), 2U);
  ASSERT_EQ(features.bearing_cam.size(), 2U);
  EXPECT_EQ(features.age_frames, (std::vector<std::uint16_t>{1, 3}));
  EXPECT_TRUE(features.bearing_cam[0].isApprox(Eigen::Vector3f::UnitZ()));
  EXPECT_TRUE(features.bearing_cam[1].isApprox(camera.bearing({10.5, 230})->cast<float>(), 1e-6F));

  Features message;
  toMessage(features, "camera", message);
  EXPECT_EQ(message.width, 320U);
  EXPECT_EQ(message.height, 240U);
  EXPECT_EQ(message.focal_length, 300);
  EXPECT_EQ(message.bearing.size(), 6U);
  EXPECT_TRUE(message.descriptor.empty());
  EXPECT_NE(faultOf(message), "") << "a mapper cannot use it, and says so";
}

}  // namespace
}  // namespace ardrone_vslam
