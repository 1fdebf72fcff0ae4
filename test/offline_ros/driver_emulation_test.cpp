// SPDX-License-Identifier: BSD-3-Clause
// What the emulated driver makes of single packets and images.
#include "driver/emulation/driver_emulation.hpp"

#include <gtest/gtest.h>
#include <tf2/LinearMath/Quaternion.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bags/messages/camera_info.hpp"
#include "driver/emulation/driver_video.hpp"
#include "sequences/drone_cameras.hpp"
#include "world/world_camera.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBegin_ns = 1'400'000'000 * kSecond_ns;

DronePacket packetAt(double yaw_rad, const Eigen::Vector3d& velocity_base_m_s) {
  DronePacket packet;
  packet.R_odom_base = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  packet.velocity_base_m_s = velocity_base_m_s;
  packet.altitude_m = 1.8;
  packet.pose_variances.setConstant(0.25);
  packet.twist_variances.setConstant(0.04);
  packet.angular_rate_base_rad_s << 0.1, 0.2, 0.3;
  return packet;
}

/// Odometry after flying for a second at 1 m/s forward, turned left by a right angle.
nav_msgs::Odometry afterASecond(const DriverFaults& faults) {
  DriverEmulation driver(faults, "");
  driver.receive(packetAt(M_PI / 2, {0, 0, 0}), kBegin_ns);
  return driver.receive(packetAt(M_PI / 2, {1, 0, 0}), kBegin_ns + kSecond_ns).odometry;
}

TEST(DriverEmulation, MirroredYawMovesToTheOtherSide) {
  EXPECT_NEAR(afterASecond({}).pose.pose.position.y, 1, 1e-12);
  EXPECT_NEAR(afterASecond({DriverFault::kMirroredYaw}).pose.pose.position.y, -1, 1e-12);
}

TEST(DriverEmulation, ARestartInFlightJumpsByTheTimeSince1970) {
  for (const bool has_fault : {false, true}) {
    DriverEmulation driver(has_fault ? DriverFaults{DriverFault::kEpochDt} : DriverFaults{}, "");
    driver.receive(packetAt(0, {0, 0, 0}), kBegin_ns);
    driver.restart();
    const auto odometry = driver.receive(packetAt(0, {0.5, 0, 0}), kBegin_ns).odometry;
    EXPECT_NEAR(odometry.pose.pose.position.x, has_fault ? 0.7e9 : 0, 1e-6);
    EXPECT_EQ(odometry.pose.pose.position.z, 1.8);
  }
}

TEST(DriverEmulation, ZeroCovarianceTellsNoTurnRateEither) {
  const auto told = afterASecond({});
  const auto zero = afterASecond({DriverFault::kZeroCovariance});
  EXPECT_EQ(told.pose.covariance[0], 0.25);
  EXPECT_EQ(told.pose.covariance[35], 0.25);
  EXPECT_EQ(told.pose.covariance[1], 0);
  EXPECT_EQ(told.twist.covariance[7], 0.04);
  EXPECT_EQ(told.twist.twist.angular.z, 0.3);
  EXPECT_EQ(zero.pose.covariance, nav_msgs::Odometry().pose.covariance);
  EXPECT_EQ(zero.twist.covariance, nav_msgs::Odometry().twist.covariance);
  EXPECT_EQ(zero.twist.twist.angular, geometry_msgs::Vector3());
  EXPECT_EQ(zero.twist.twist.linear, told.twist.twist.linear);
}

TEST(DriverEmulation, FusedAltitudeStepsAtATable) {
  for (const bool has_fault : {false, true}) {
    DriverEmulation driver(has_fault ? DriverFaults{DriverFault::kFusedAltitude} : DriverFaults{},
                           "");
    driver.receive(packetAt(0, {0, 0, 0}), kBegin_ns);
    DronePacket above_table = packetAt(0, {0, 0, 0.1});
    above_table.altitude_m = 1.0504;
    const auto messages = driver.receive(above_table, kBegin_ns + kSecond_ns);
    EXPECT_NEAR(messages.odometry.pose.pose.position.z, has_fault ? 1.05 : 1.9, 1e-12);
    EXPECT_EQ(messages.navdata.altd, 1050);
  }
  EXPECT_EQ(afterASecond({DriverFault::kWholeMetres}).pose.pose.position.z, 1);
}

TEST(DriverEmulation, PrefixIsOnAllFramesButTheFaultyOne) {
  for (const bool has_fault : {false, true}) {
    DriverEmulation driver(has_fault ? DriverFaults{DriverFault::kUnprefixedFrame} : DriverFaults{},
                           "drone1");
    const auto messages = driver.receive(packetAt(0, {0, 0, 0}), kBegin_ns);
    EXPECT_EQ(messages.odometry.header.frame_id, has_fault ? "odom" : "drone1/odom");
    EXPECT_EQ(messages.odometry.child_frame_id, "drone1/ardrone_base_link");
    EXPECT_EQ(messages.T_odom_base.header.frame_id, "drone1/odom");
    EXPECT_EQ(messages.T_odom_base.child_frame_id, "drone1/ardrone_base_link");
    EXPECT_EQ(messages.imu.header.frame_id, "drone1/ardrone_base_link");
    EXPECT_EQ(driver.cameraTransforms(kBegin_ns)[1].child_frame_id,
              "drone1/ardrone_base_bottomcam");
  }
}

TEST(DriverEmulation, NavdataHasTheDriversUnitsAndLayout) {
  // Of ardrone_autonomy/Navdata.
  EXPECT_STREQ(ros::message_traits::md5sum<Navdata>(), "e1169f766234363125ac62c9a3f87eeb");
  DronePacket packet = packetAt(0.5, {0.4, -0.3, 0.2});
  packet.R_odom_base = packet.R_odom_base * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()) *
                       Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitX());
  packet.specific_force_base_m_s2 << 0.981, 0, 9.81;
  packet.magnetic_field_base << 30, 0, -40;
  packet.state = DronePacket::State::kHovering;
  packet.clock_s = 2048 + 12.5;
  const auto messages = DriverEmulation({}, "").receive(packet, kBegin_ns);
  const Navdata& navdata = messages.navdata;
  EXPECT_NEAR(navdata.rotX, -0.1 * 180 / M_PI, 1e-5);
  EXPECT_NEAR(navdata.rotY, 0.2 * 180 / M_PI, 1e-5);
  EXPECT_NEAR(navdata.rotZ, 0.5 * 180 / M_PI, 1e-5);
  EXPECT_FLOAT_EQ(navdata.vx, 400);
  EXPECT_FLOAT_EQ(navdata.vy, -300);
  EXPECT_FLOAT_EQ(navdata.vz, 200);
  EXPECT_FLOAT_EQ(navdata.ax, 0.1F);
  EXPECT_FLOAT_EQ(navdata.az, 1);
  EXPECT_EQ(navdata.altd, 1800);
  EXPECT_EQ(navdata.state, 4U);
  EXPECT_FLOAT_EQ(navdata.tm, 12.5e6F);
  EXPECT_NEAR(messages.imu.linear_acceleration.z, 9.8, 1e-6);
  EXPECT_EQ(messages.imu.angular_velocity.z, 0.3);
  EXPECT_NEAR(messages.mag.vector.x, 0.6, 1e-12);
  EXPECT_NEAR(messages.mag.vector.z, -0.8, 1e-12);
}

TEST(DriverEmulation, CamerasAreMountedAsTheDriverSays) {
  const auto transforms = DriverEmulation({}, "").cameraTransforms(kBegin_ns);
  ASSERT_EQ(transforms.size(), 2U);
  const double deg = M_PI / 180;
  const std::vector<std::array<double, 3>> rpy{{-90 * deg, 0, -90 * deg}, {M_PI, 0, 90 * deg}};
  const std::vector<std::string> frames{"ardrone_base_frontcam", "ardrone_base_bottomcam"};
  const std::vector<Eigen::Vector3d> places{{0.21, 0, 0}, {0, -0.02, 0}};
  for (std::size_t i = 0; i < 2; ++i) {
    tf2::Quaternion wanted;
    wanted.setRPY(rpy[i][0], rpy[i][1], rpy[i][2]);
    const auto& q = transforms[i].transform.rotation;
    EXPECT_NEAR(std::abs(wanted.dot(tf2::Quaternion(q.x, q.y, q.z, q.w))), 1, 1e-12);
    const auto& t = transforms[i].transform.translation;
    EXPECT_TRUE(Eigen::Vector3d(t.x, t.y, t.z).isApprox(places[i]));
    EXPECT_EQ(transforms[i].child_frame_id, frames[i]);
    EXPECT_EQ(transforms[i].header.frame_id, "ardrone_base_link");
  }
}

TEST(DriverVideo, TheBottomStreamAndItsCalibrationFitEachOther) {
  const CameraIntrinsics& camera = cameraNamed("bottom").intrinsics;
  // Steep ramps: a tenth of a pixel shows. The left half rises along x, the right one along y.
  constexpr double kSlope = 4;
  constexpr int kFrom_px = 90;
  cv::Mat image(camera.height_px, camera.width_px, CV_8U);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(kSlope * ((x < 160 ? x : y) - kFrom_px));
    }
  }
  const cv::Mat stream = streamImage(image);
  ASSERT_EQ(stream.size(), cv::Size(640, 360));
  ASSERT_EQ(stream.type(), CV_8UC3);
  const CameraModel before(camera);
  const CameraModel after(streamCalibration(camera));
  const std::vector<Eigen::Vector2i> pixels{{200, 20}, {270, 300}, {500, 150}};
  for (const Eigen::Vector2i& pixel : pixels) {
    const Eigen::Vector2d there = *before.project(*after.bearing(pixel.cast<double>()));
    const double coordinate = there.x() < 160 ? there.x() : there.y();
    const auto grey = stream.at<cv::Vec3b>(pixel.y(), pixel.x());
    EXPECT_NEAR(grey[0], kSlope * (coordinate - kFrom_px), 0.51);
    EXPECT_EQ(grey[0], grey[2]);
  }
}

TEST(DriverVideo, UnscaledChangesAllButTheSize) {
  for (const std::string name : {"front", "bottom"}) {
    const CameraIntrinsics& camera = cameraNamed(name).intrinsics;
    const auto scaled = streamCameraInfo(camera, false);
    const auto unscaled = streamCameraInfo(camera, true);
    EXPECT_EQ(scaled.width, 640U);
    EXPECT_EQ(scaled.height, 360U);
    EXPECT_EQ(unscaled.width, 640U);
    EXPECT_EQ(unscaled.height, 360U);
    EXPECT_EQ(unscaled.D, scaled.D);
    EXPECT_NEAR(unscaled.K[0] / scaled.K[0], name == "front" ? 2 : 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace ardrone_vslam
