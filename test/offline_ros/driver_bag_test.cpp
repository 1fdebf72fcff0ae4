// SPDX-License-Identifier: BSD-3-Clause
// Bags as the AR.Drone's driver would have them recorded.
#include "driver/emulation/driver_bag.hpp"

#include <gtest/gtest.h>

#include "driver_recording.hpp"

namespace ardrone_vslam {
namespace {

TEST(DriverBag, TopicsTypesAndFramesAreTheDrivers) {
  const DriverRecording recording({});
  const std::map<std::string, std::string> wanted{
      {"/ardrone/camera_info", "sensor_msgs/CameraInfo"},
      {"/ardrone/front/camera_info", "sensor_msgs/CameraInfo"},
      {"/ardrone/front/image_raw", "sensor_msgs/Image"},
      {"/ardrone/image_raw", "sensor_msgs/Image"},
      {"/ardrone/imu", "sensor_msgs/Imu"},
      {"/ardrone/mag", "geometry_msgs/Vector3Stamped"},
      {"/ardrone/navdata", "ardrone_vslam/Navdata"},
      {"/ardrone/odometry", "nav_msgs/Odometry"},
      {"/make_bag/info", "std_msgs/String"},
      {"/tf", "tf2_msgs/TFMessage"},
      {"/truth/pose", "geometry_msgs/PoseStamped"}};
  EXPECT_EQ(recording.types(), wanted);
  for (const auto& image : recording.read<sensor_msgs::Image>("/ardrone/front/image_raw")) {
    EXPECT_EQ(image.header.frame_id, "ardrone_base_frontcam");
    EXPECT_EQ(image.encoding, "rgb8");
    EXPECT_EQ(image.width, 640U);
    EXPECT_EQ(image.height, 360U);
  }
  const auto odometry = recording.odometry().front();
  EXPECT_EQ(odometry.header.frame_id, "odom");
  EXPECT_EQ(odometry.child_frame_id, "ardrone_base_link");
  EXPECT_EQ(recording.read<Navdata>("/ardrone/navdata").front().header.frame_id,
            "ardrone_base_link");
  EXPECT_EQ(recording.read<geometry_msgs::PoseStamped>("/truth/pose").front().header.frame_id,
            "map");
}

TEST(DriverBag, RatesAndStampsAreTheDrivers) {
  const DriverRecording recording({});
  // 1.5 s: navdata at 200 Hz, images at 4 Hz as the test asks for, tf of the cameras at 10 Hz.
  for (const std::string topic :
       {"/ardrone/navdata", "/ardrone/imu", "/ardrone/mag", "/ardrone/odometry"}) {
    const auto stamps_ns = recording.stamps_ns(topic);
    ASSERT_EQ(stamps_ns.size(), 301U) << topic;
    EXPECT_EQ(stamps_ns.front(), kDriverBagBegin_ns);
    for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
      EXPECT_EQ(stamps_ns[i] - stamps_ns[i - 1], 5'000'000) << topic;
    }
  }
  EXPECT_EQ(recording.stamps_ns("/ardrone/image_raw").size(), 6U);
  EXPECT_EQ(recording.stamps_ns("/ardrone/image_raw"),
            recording.stamps_ns("/ardrone/front/camera_info"));
  std::map<std::string, std::size_t> transforms;
  for (const auto& tf : recording.read<tf2_msgs::TFMessage>("/tf")) {
    ASSERT_EQ(tf.transforms.size(), 1U);
    ++transforms[tf.transforms[0].header.frame_id + " " + tf.transforms[0].child_frame_id];
  }
  const std::map<std::string, std::size_t> wanted{{"ardrone_base_link ardrone_base_bottomcam", 16},
                                                  {"ardrone_base_link ardrone_base_frontcam", 16},
                                                  {"odom ardrone_base_link", 301}};
  EXPECT_EQ(transforms, wanted);
  EXPECT_TRUE(recording.isRecordedAtItsStamps());
}

TEST(DriverBag, TwistIntegratesToTheOdometryAndWithoutDriftToTheTruth) {
  for (const std::string profile : {"truth", "drone"}) {
    const DriverRecording recording({}, profile);
    const auto odometry = recording.odometry();
    const auto truth = recording.read<geometry_msgs::PoseStamped>("/truth/pose");
    ASSERT_EQ(odometry.size(), truth.size());
    const Eigen::Vector3d begin = positionOf(odometry.front().pose.pose);
    const Eigen::Vector3d offset = positionOf(truth.front().pose) - begin;
    EXPECT_EQ(begin.head<2>().norm(), 0);
    EXPECT_NEAR(offset.z(), 0, profile == "truth" ? 1e-9 : 1e-3);
    Eigen::Vector3d position = begin;
    for (std::size_t i = 1; i < odometry.size(); ++i) {
      const double dt_s = (odometry[i].header.stamp - odometry[i - 1].header.stamp).toSec();
      position += dt_s * (rotationOf(odometry[i].pose.pose) * velocityOf(odometry[i]));
      EXPECT_NEAR((position - positionOf(odometry[i].pose.pose)).norm(), 0, 1e-9);
      if (profile != "truth") continue;
      EXPECT_NEAR((position + offset - positionOf(truth[i].pose)).norm(), 0, 1e-9);
      EXPECT_NEAR(rotationOf(odometry[i].pose.pose).angularDistance(rotationOf(truth[i].pose)), 0,
                  1e-7);
    }
    const double displacement_m =
        (positionOf(truth.back().pose) - positionOf(truth.front().pose)).norm();
    EXPECT_GT(displacement_m, 0.01);
  }
}

TEST(DriverBag, InertialMeasurementsAreTheMotions) {
  const DriverRecording recording({}, "truth");
  const auto imu = recording.read<sensor_msgs::Imu>("/ardrone/imu");
  const auto odometry = recording.odometry();
  Eigen::Quaterniond attitude = rotationOf(odometry.front().pose.pose);
  for (std::size_t i = 1; i < imu.size(); ++i) {
    // The middle of the step, for which the mean of the rates at its ends stands.
    const auto& before = imu[i - 1].angular_velocity;
    const auto& after = imu[i].angular_velocity;
    const Eigen::Vector3d turn =
        0.0025 * Eigen::Vector3d(before.x + after.x, before.y + after.y, before.z + after.z);
    attitude = attitude * Eigen::AngleAxisd(turn.norm(), turn.stableNormalized());
  }
  EXPECT_NEAR(attitude.angularDistance(rotationOf(odometry.back().pose.pose)), 0, 1e-5);
  EXPECT_NEAR(imu.front().linear_acceleration.z, 9.8, 0.01);
}

TEST(DriverBag, TheBottomCameraStreamsAlone) {
  const DriverRecording recording({}, "drone", "bottom");
  EXPECT_EQ(recording.types().count("/ardrone/front/image_raw"), 0U);
  const auto info = recording.read<sensor_msgs::CameraInfo>("/ardrone/bottom/camera_info").front();
  EXPECT_EQ(info.header.frame_id, "ardrone_base_bottomcam");
  EXPECT_EQ(info.width, 640U);
  EXPECT_NEAR(info.K[0], 2 * 316.8, 1e-9);
}

TEST(DriverBag, EqualArgumentsGiveEqualBytes) {
  const DriverFaults all = driverFaultsNamed({"all"});
  EXPECT_EQ(DriverRecording(all).bytes(), DriverRecording(all).bytes());
}

}  // namespace
}  // namespace ardrone_vslam
