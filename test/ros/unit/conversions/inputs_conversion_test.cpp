// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "conversions/conversions.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

sensor_msgs::CameraInfo goodInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 360;
  info.distortion_model = "plumb_bob";
  info.D = {-0.52, 0.27, 0.001, -0.002, 0.03};
  info.K = {570, 0, 320, 0, 571, 180, 0, 0, 1};
  info.P = {500, 0, 310, 0, 0, 501, 170, 0, 0, 0, 1, 0};
  return info;
}

TEST(CameraInfoConversion, PlumbBob) {
  const auto camera = toIntrinsics(goodInfo()).value;
  ASSERT_TRUE(camera);
  CameraIntrinsics expected;
  expected.width_px = 640;
  expected.height_px = 360;
  expected.fx_px = 570;
  expected.fy_px = 571;
  expected.cx_px = 320;
  expected.cy_px = 180;
  expected.k1 = -0.52;
  expected.k2 = 0.27;
  expected.p1 = 0.001;
  expected.p2 = -0.002;
  expected.k3 = 0.03;
  EXPECT_TRUE(*camera == expected);
}

TEST(CameraInfoConversion, RectifiedTakesProjectionAndNoDistortion) {
  auto info = goodInfo();
  info.distortion_model = "equidistant";  // of the camera, not of its rectified images
  const auto camera = toIntrinsics(info, {true, false}).value;
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->fx_px, 500);
  EXPECT_EQ(camera->fy_px, 501);
  EXPECT_EQ(camera->cx_px, 310);
  EXPECT_EQ(camera->cy_px, 170);
  EXPECT_EQ(camera->k1, 0);
}

constexpr CameraInfoUse kRescale{false, true};

/// K of images `factor` times as wide, whose centres of pixels have whole coordinates.
sensor_msgs::CameraInfo calibratedAt(double factor, double cut_px = 0) {
  auto info = goodInfo();
  info.K[0] *= factor;
  info.K[4] *= factor;
  info.K[2] = (info.K[2] + 0.5) * factor - 0.5;
  info.K[5] = (info.K[5] + 0.5 + cut_px) * factor - 0.5;
  return info;
}

void expectNear(const CameraIntrinsics& camera, const CameraIntrinsics& expected) {
  EXPECT_NEAR(camera.fx_px, expected.fx_px, 1e-9);
  EXPECT_NEAR(camera.fy_px, expected.fy_px, 1e-9);
  EXPECT_NEAR(camera.cx_px, expected.cx_px, 1e-9);
  EXPECT_NEAR(camera.cy_px, expected.cy_px, 1e-9);
  EXPECT_EQ(camera.k1, expected.k1);
}

TEST(CameraInfoConversion, ACalibrationOfAnotherSizeIsTakenForTheImagesWhereAskedFor) {
  const CameraIntrinsics expected = *toIntrinsics(goodInfo()).value;
  const auto large = calibratedAt(2);
  EXPECT_NE(toIntrinsics(large).fault.find("rescale_calibration"), std::string::npos);
  expectNear(*toIntrinsics(large, kRescale).value, expected);
  // The bottom camera's 320x240, doubled and cut to 640x360.
  expectNear(*toIntrinsics(calibratedAt(0.5, 60), kRescale).value, expected);
  expectNear(*toIntrinsics(calibratedAt(0.5), kRescale).value, expected);
}

TEST(CameraInfoConversion, RescalingLeavesACentreFarFromTheMiddleAlone) {
  for (const double off_px : {-90.0, 90.0}) {
    auto info = goodInfo();
    info.K[2] += off_px;
    info.K[5] += off_px / 2;
    EXPECT_TRUE(*toIntrinsics(info, kRescale).value == *toIntrinsics(info).value) << off_px;
  }
  auto uncalibrated = goodInfo();
  uncalibrated.K.fill(0);
  EXPECT_NE(toIntrinsics(uncalibrated, kRescale).fault.find("uncalibrated"), std::string::npos);
}

TEST(CameraInfoConversion, NoLens) {
  auto info = goodInfo();
  info.distortion_model.clear();
  info.D.clear();
  const auto camera = toIntrinsics(info).value;
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->k1, 0);
}

TEST(CameraInfoConversion, FourCoefficients) {
  auto info = goodInfo();
  info.D.pop_back();
  const auto camera = toIntrinsics(info).value;
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->p2, -0.002);
  EXPECT_EQ(camera->k3, 0);
}

TEST(CameraInfoConversion, RationalWithoutDenominatorIsPlumbBob) {
  auto info = goodInfo();
  info.distortion_model = "rational_polynomial";
  info.D.resize(8, 0.0);
  const auto camera = toIntrinsics(info).value;
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->k3, 0.03);
}

struct SpoiledInfo {
  std::vector<const char*> expected;
  std::function<void(sensor_msgs::CameraInfo&)> spoil;
};

class CameraInfoFault : public testing::TestWithParam<SpoiledInfo> {};

TEST_P(CameraInfoFault, IsNamed) {
  auto info = goodInfo();
  GetParam().spoil(info);
  const auto checked = toIntrinsics(info);
  EXPECT_FALSE(checked.value);
  for (const char* part : GetParam().expected) {
    EXPECT_NE(checked.fault.find(part), std::string::npos) << checked.fault;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, CameraInfoFault,
    testing::Values(
        SpoiledInfo{{"'rational_polynomial'", "D[6]", "plumb_bob"},
                    [](auto& i) {
                      i.distortion_model = "rational_polynomial";
                      i.D.resize(8, 0.0);
                      i.D[6] = 0.1;
                    }},
        SpoiledInfo{{"'equidistant'", "rectif"},
                    [](auto& i) { i.distortion_model = "equidistant"; }},
        SpoiledInfo{{"no distortion_model"}, [](auto& i) { i.distortion_model.clear(); }},
        SpoiledInfo{{"D has 2"}, [](auto& i) { i.D.resize(2); }},
        SpoiledInfo{{"D is not finite"}, [](auto& i) { i.D[1] = kNaN; }},
        SpoiledInfo{{"K is not finite"}, [](auto& i) { i.K[2] = kNaN; }},
        SpoiledInfo{{"uncalibrated", "camera_calibration"}, [](auto& i) { i.K.fill(0); }},
        SpoiledInfo{{"image size of 0x360"}, [](auto& i) { i.width = 0; }},
        SpoiledInfo{{"(320, 180)", "another image size"},
                    [](auto& i) {
                      i.width = 300;
                      i.height = 200;
                    }},
        SpoiledInfo{{"uncalibrated"}, [](auto& i) { i.K[4] = -571; }},
        SpoiledInfo{{"focal length 1e+300 px", "calibrate"}, [](auto& i) { i.K[0] = 1e300; }},
        SpoiledInfo{{"k1 -900", "folds back"},
                    [](auto& i) {
                      i.D = {-900, 5000, 3, 3, 1e5};
                    }},
        SpoiledInfo{{"binning"}, [](auto& i) { i.binning_x = 2; }},
        SpoiledInfo{{"region of interest", "320x360 at (0, 0)"},
                    [](auto& i) {
                      i.roi.width = 320;
                      i.roi.height = 360;
                    }},
        SpoiledInfo{{"region of interest", "at (8, 0)"}, [](auto& i) { i.roi.x_offset = 8; }}));

TEST(CameraInfoConversion, RegionOfInterestMayBeTheWholeImage) {
  auto info = goodInfo();
  info.roi.width = 640;
  info.roi.height = 360;
  EXPECT_TRUE(toIntrinsics(info).value);
}

nav_msgs::Odometry goodOdometry() {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = ros::Time(12, 345);
  odometry.pose.pose.position.x = 1;
  odometry.pose.pose.position.y = 2;
  odometry.pose.pose.position.z = 3;
  odometry.pose.pose.orientation.z = 0.6;
  odometry.pose.pose.orientation.w = 0.8;
  for (std::size_t i = 0; i < 36; ++i) odometry.pose.covariance[i] = 0.01 * static_cast<double>(i);
  return odometry;
}

TEST(OdometryConversion, PoseAndCovariance) {
  const auto state = toOdometryState(goodOdometry()).value;
  ASSERT_TRUE(state);
  EXPECT_EQ(state->stamp_ns, 12'000'000'345);
  EXPECT_EQ(state->T_odom_base.translation(), Eigen::Vector3d(1, 2, 3));
  // Turned by 2 asin(0.6) about z.
  const Eigen::Vector3d forward = state->T_odom_base.linear() * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(forward.isApprox(Eigen::Vector3d(0.28, 0.96, 0), 1e-12));
  EXPECT_EQ(state->covariance(0, 1), 0.01);
  EXPECT_EQ(state->covariance(1, 0), 0.06);
}

TEST(OdometryConversion, QuaternionIsNormalised) {
  auto odometry = goodOdometry();
  odometry.pose.pose.orientation.z *= 1.05;
  odometry.pose.pose.orientation.w *= 1.05;
  const auto state = toOdometryState(odometry).value;
  ASSERT_TRUE(state);
  const Eigen::Matrix3d r = state->T_odom_base.linear();
  EXPECT_TRUE((r * r.transpose()).isIdentity(1e-12));
}

TEST(OdometryConversion, AVarianceThatMeansUnknownIsNoReasonToRefuse) {
  for (const double marker : {-1.0, 1e9, std::numeric_limits<double>::max()}) {
    auto odometry = goodOdometry();
    odometry.pose.covariance[7] = marker;
    const auto state = toOdometryState(odometry).value;
    ASSERT_TRUE(state);
    EXPECT_NE(covarianceFault(*state), "");
  }
}

struct SpoiledOdometry {
  const char* expected;
  std::function<void(nav_msgs::Odometry&)> spoil;
};

class SpoiledOdometryMessage : public testing::TestWithParam<SpoiledOdometry> {};

TEST_P(SpoiledOdometryMessage, IsNamed) {
  auto odometry = goodOdometry();
  GetParam().spoil(odometry);
  const auto checked = toOdometryState(odometry);
  EXPECT_FALSE(checked.value);
  EXPECT_NE(checked.fault.find(GetParam().expected), std::string::npos) << checked.fault;
}

INSTANTIATE_TEST_SUITE_P(
    All, SpoiledOdometryMessage,
    testing::Values(
        SpoiledOdometry{"position", [](auto& o) { o.pose.pose.position.z = kNaN; }},
        SpoiledOdometry{"orientation is not finite",
                        [](auto& o) { o.pose.pose.orientation.x = kNaN; }},
        SpoiledOdometry{"norm 0", [](auto& o) { o.pose.pose.orientation = {}; }},
        SpoiledOdometry{"norm 1.2", [](auto& o) { o.pose.pose.orientation.z = 0.9; }},
        SpoiledOdometry{"pose covariance is not finite",
                        [](auto& o) { o.pose.covariance[8] = kNaN; }},
        SpoiledOdometry{"twist is not finite", [](auto& o) { o.twist.twist.linear.y = kNaN; }},
        SpoiledOdometry{"twist is not finite", [](auto& o) { o.twist.twist.angular.z = kNaN; }},
        SpoiledOdometry{"twist covariance is not finite",
                        [](auto& o) { o.twist.covariance[35] = kNaN; }},
        SpoiledOdometry{"coordinate of 1e+300 m, beyond 1e+07 m; check its unit",
                        [](auto& o) { o.pose.pose.position.x = -1e300; }},
        SpoiledOdometry{"component of 1e+300, beyond 1000 m/s or rad/s",
                        [](auto& o) { o.twist.twist.linear.x = 1e300; }},
        SpoiledOdometry{"stamp is zero", [](auto& o) { o.header.stamp = ros::Time(); }}));

TEST(OdometryConversion, AStateThereAndBack) {
  OdometryState state;
  state.stamp_ns = 5'000'000'007;
  state.T_odom_base =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized());
  state.covariance.setConstant(0.5);
  state.covariance(0, 4) = 7;
  state.twist_base << 1, 2, 3, 4, 5, 6;
  state.twist_covariance(1, 2) = 12;
  const nav_msgs::Odometry message = toOdometryMessage(state, "observer_odom", "base");
  EXPECT_EQ(message.header.frame_id, "observer_odom");
  EXPECT_EQ(message.child_frame_id, "base");
  const auto back = toUnboundedState(message).value;
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp_ns, state.stamp_ns);
  EXPECT_TRUE(back->T_odom_base.isApprox(state.T_odom_base, 1e-12));
  EXPECT_EQ(back->covariance, state.covariance);
  EXPECT_EQ(back->twist_base, state.twist_base);
  EXPECT_EQ(back->twist_covariance, state.twist_covariance);
}

TEST(TimeConversion, RoundTripIsExact) {
  for (const std::int64_t stamp_ns :
       {std::int64_t{1}, std::int64_t{999'999'999}, std::int64_t{1'700'000'000'123'456'789}}) {
    EXPECT_EQ(toNanoseconds(toRosTime(stamp_ns)), stamp_ns);
  }
}

TEST(InputsConversion, RangeKeepsItsBounds) {
  sensor_msgs::Range message;
  EXPECT_FALSE(toRangeReading(message).value) << "no stamp";
  message.header.stamp = ros::Time(3, 5);
  message.range = 1.5F;
  message.min_range = 0.25F;
  message.max_range = 4;
  const auto reading = toRangeReading(message);
  ASSERT_TRUE(reading.value);
  EXPECT_EQ(reading.value->stamp_ns, 3'000'000'005);
  EXPECT_EQ(reading.value->range_m, 1.5);
  EXPECT_EQ(reading.value->min_m, 0.25);
  EXPECT_EQ(reading.value->max_m, 4);
}

TEST(PlaceHintConversion, IsRvizsClick) {
  geometry_msgs::PoseWithCovarianceStamped click;
  click.header.frame_id = "map";
  click.pose.pose.position.x = 1.5;
  click.pose.pose.position.y = -2;
  click.pose.pose.orientation.z = std::sin(0.35);
  click.pose.pose.orientation.w = std::cos(0.35);
  click.pose.covariance[0] = 0.25;
  click.pose.covariance[7] = 4;
  click.pose.covariance[35] = 0.09;
  const PlaceHint hint = *toPlaceHint(click, "map").value;
  EXPECT_EQ(hint.position_map_m, Eigen::Vector2d(1.5, -2));
  EXPECT_NEAR(hint.heading_rad, 0.7, 1e-12);
  EXPECT_EQ(hint.position_sigma_m, 2);
  EXPECT_EQ(hint.heading_sigma_rad, 0.3);

  click.pose.covariance[0] = click.pose.covariance[7] = 0;
  click.pose.covariance[35] = kNaN;
  EXPECT_EQ(toPlaceHint(click, "map").value->position_sigma_m, PlaceHint{}.position_sigma_m);
  EXPECT_EQ(toPlaceHint(click, "map").value->heading_sigma_rad, PlaceHint{}.heading_sigma_rad);

  EXPECT_NE(toPlaceHint(click, "vslam_map").fault.find("must be 'vslam_map'"), std::string::npos);
  click.pose.pose.position.x = kNaN;
  EXPECT_FALSE(toPlaceHint(click, "map").value);
}

}  // namespace
}  // namespace ardrone_vslam
