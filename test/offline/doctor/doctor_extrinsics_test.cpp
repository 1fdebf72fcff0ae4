// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/camera/doctor_extrinsics.hpp"

#include <gtest/gtest.h>

#include "doctor/camera/doctor_motion.hpp"
#include "support/doctor_findings.hpp"
#include "support/doctor_recordings.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDeg = M_PI / 180;

std::vector<OdometryState> odometry() {
  std::vector<OdometryState> states;
  for (int i = 0; i < 1240; ++i) states.push_back(test::doctorState(0.01 * (i - 20)));
  return states;
}

ExtrinsicsEstimate estimate(const std::vector<ImageFeatures>& images,
                            const std::vector<OdometryState>& states,
                            const Eigen::Matrix3d& R_told) {
  const std::vector<ImagePair> pairs = movingPairs(images);
  return estimateExtrinsics(pairs, {states, forwardCamera().translation()}, R_told);
}

double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

TEST(DoctorExtrinsics, AgreesWithARightTf) {
  const Eigen::Matrix3d R = forwardCamera().linear();
  const ExtrinsicsEstimate found = estimate(test::doctorViews(forwardCamera()), odometry(), R);
  EXPECT_EQ(found.state, ExtrinsicsState::kFound);
  EXPECT_LT(found.off_rad, 1 * kDeg);
  EXPECT_LT(std::abs(found.offset_s), 0.005);
}

TEST(DoctorExtrinsics, FindsACameraTurnedByQuartersAboutAnyAxis) {
  const Eigen::Matrix3d R = forwardCamera().linear();
  const auto images = test::doctorViews(forwardCamera());
  const auto states = odometry();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angle : {90 * kDeg, 180 * kDeg, -90 * kDeg}) {
      const Eigen::Matrix3d R_told = R * rotationOf(angle * Eigen::Vector3d::Unit(axis));
      const ExtrinsicsEstimate found = estimate(images, states, R_told);
      EXPECT_EQ(found.state, ExtrinsicsState::kFound);
      EXPECT_LT(angleBetween(found.R_base_cam, R), 1 * kDeg);
      EXPECT_NEAR(found.off_rad, std::abs(angle), 1 * kDeg);
    }
  }
}

TEST(DoctorExtrinsics, FindsASmallTurn) {
  const Eigen::Matrix3d R = forwardCamera().linear();
  const Eigen::Matrix3d R_told = R * rotationOf({10 * kDeg, -5 * kDeg, 3 * kDeg});
  const ExtrinsicsEstimate found = estimate(test::doctorViews(forwardCamera()), odometry(), R_told);
  EXPECT_LT(angleBetween(found.R_base_cam, R), 1 * kDeg);
}

TEST(DoctorExtrinsics, FindsLateImagesEvenOfATurnedCamera) {
  const Eigen::Matrix3d R = forwardCamera().linear();
  const Eigen::Matrix3d R_told = R * rotationOf({0, 0, M_PI});
  for (const double late_s : {-0.06, 0.04, 0.15}) {
    const ExtrinsicsEstimate found =
        estimate(test::doctorViews(forwardCamera(), late_s), odometry(), R_told);
    EXPECT_EQ(found.state, ExtrinsicsState::kFound);
    EXPECT_NEAR(found.offset_s, -late_s, 0.01);
    EXPECT_LT(angleBetween(found.R_base_cam, R), 1 * kDeg);
  }
}

TEST(DoctorExtrinsics, SaysWhatItCannotTell) {
  const Eigen::Matrix3d R = forwardCamera().linear();
  // Two seconds are too few pairs of images.
  EXPECT_EQ(estimate(test::doctorViews(forwardCamera(), 0, 2), odometry(), R).state,
            ExtrinsicsState::kTooLittleMotion);
  // Odometry that stands still explains nothing.
  std::vector<OdometryState> still = odometry();
  for (OdometryState& state : still) state.T_odom_base.setIdentity();
  EXPECT_NE(estimate(test::doctorViews(forwardCamera()), still, R).state, ExtrinsicsState::kFound);
  // Straight ahead without a turn: the image may be turned about the optical axis.
  std::vector<OdometryState> straight;
  for (int i = 0; i < 1200; ++i) {
    OdometryState state;
    state.stamp_ns = test::doctorStamp_ns(0.01 * i);
    state.T_odom_base.translation().x() = 0.01 * i;
    straight.push_back(state);
  }
  std::vector<ImageFeatures> images;
  for (int i = 0; i < 120; ++i) {
    ImageFeatures features;
    features.stamp_ns = test::doctorStamp_ns(0.1 * i);
    features.focal_length_px = 570;
    for (int p = 0; p < 400; ++p) {
      const Eigen::Vector3d point(0.4 * (p % 10) - 1.8, 0.3 * (p / 10 % 4) - 0.45,
                                  1.5 * (p / 40) + 2 - 0.1 * i);
      const Eigen::Vector3d bearing = point.normalized();
      if (bearing.z() < 0.85) continue;
      features.pixel_px.emplace_back(0.F, 0.F);
      features.bearing_cam.push_back(bearing.cast<float>());
      features.track_id.push_back(static_cast<std::uint32_t>(p + 1));
    }
    images.push_back(features);
  }
  EXPECT_EQ(estimate(images, straight, R).state, ExtrinsicsState::kAmbiguous);
}

TEST(DoctorExtrinsics, PrintsTheCorrectedTransform) {
  const DoctorRecording good = test::goodRecording();
  Tracks tracks;
  tracks.cameras.push_back({"cam", test::doctorCamera(), test::doctorViews(forwardCamera())});
  std::string line;
  auto cameras = estimateAllExtrinsics(good, tracks, odometry());
  EXPECT_EQ(test::verdictOf(checkDirections(cameras, "base", line), "camera_direction"),
            Verdict::kOk);
  EXPECT_TRUE(line.empty());

  DoctorRecording turned = good;
  turned.transforms["cam"].T_parent_child = Eigen::Translation3d(0.1, 0.2, 0) * forwardCamera() *
                                            Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ());
  tracks.cameras[0].images = test::doctorViews(Eigen::Translation3d(0.1, 0.2, 0) * forwardCamera());
  cameras = estimateAllExtrinsics(turned, tracks, odometry());
  EXPECT_EQ(test::verdictOf(checkDirections(cameras, "base", line), "camera_direction"),
            Verdict::kFault);
  EXPECT_EQ(line, "rosrun tf2_ros static_transform_publisher 0.1 0.2 0 -1.5708 0 -1.5708 base cam");
}

TEST(DoctorExtrinsics, SuggestsTheTimeOffset) {
  Tracks tracks;
  tracks.cameras.push_back({"cam", test::doctorCamera(), test::doctorViews(forwardCamera(), 0.09)});
  std::vector<SuggestedParameter> parameters;
  const auto cameras = estimateAllExtrinsics(test::goodRecording(), tracks, odometry());
  EXPECT_EQ(checkTimeOffset(cameras, parameters).verdict, Verdict::kWarning);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_NEAR(std::stod(parameters[0].value), -0.09, 0.01);
  EXPECT_EQ(checkTimeOffset({}, parameters).verdict, Verdict::kNotChecked);
}

TEST(DoctorMotion, NoticesOdometryThatStandsStillWhileTheImagesMove) {
  const DoctorRecording good = test::goodRecording();
  Tracks tracks;
  tracks.cameras.push_back({"cam", test::doctorCamera(), test::doctorViews(forwardCamera())});
  EXPECT_EQ(checkMoves(good, tracks, odometry()).verdict, Verdict::kOk);
  std::vector<OdometryState> still = odometry();
  for (OdometryState& state : still) state.T_odom_base.setIdentity();
  EXPECT_EQ(checkMoves(good, tracks, still).verdict, Verdict::kFault);
  EXPECT_EQ(checkMoves(good, {}, still).verdict, Verdict::kWarning);
  EXPECT_EQ(checkMoves(good, tracks, {}).verdict, Verdict::kNotChecked);
}

}  // namespace
}  // namespace ardrone_vslam
