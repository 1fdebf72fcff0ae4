// SPDX-License-Identifier: BSD-3-Clause
// The package's own observer of what the driver recorded.
#include <gtest/gtest.h>

#include "bags/bag_sequence.hpp"
#include "driver_recording.hpp"
#include "with_ros/navdata_conversion.hpp"

namespace ardrone_vslam {
namespace {

TEST(DriverNavdata, HasTheUnitsOfTheFilter) {
  Navdata message;
  EXPECT_FALSE(toNavdataReading(message).value) << "no stamp";
  message.header.stamp.fromNSec(5'000'000'000);
  message.rotX = 10;
  message.rotY = 20;
  message.rotZ = 30;
  message.vx = 1500;
  message.vy = -200;
  message.altd = 850;
  message.az = 1;
  message.state = 2;
  const auto reading = toNavdataReading(message).value;
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->stamp_ns, 5'000'000'000);
  EXPECT_TRUE(reading->is_standing);
  EXPECT_NEAR(reading->measured.height_m, 0.85, 1e-9);
  EXPECT_TRUE(reading->measured.flow_base_m_s.isApprox(Eigen::Vector2d(1.5, -0.2), 1e-6));
  EXPECT_TRUE(reading->measured.force_base_m_s2.isApprox(Eigen::Vector3d(0, 0, 9.81)));
  const Eigen::Matrix3d& R = reading->measured.R_odom_base;
  constexpr double kDegPerRad = 180 / M_PI;
  EXPECT_NEAR(std::atan2(R(2, 1), R(2, 2)) * kDegPerRad, 10, 1e-5);
  EXPECT_NEAR(std::asin(-R(2, 0)) * kDegPerRad, 20, 1e-5);
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)) * kDegPerRad, 30, 1e-5);
  message.state = 4;
  EXPECT_FALSE(toNavdataReading(message).value->is_standing);
}

TEST(DriverNavdata, ItsHeightIsAVerticalReadingWithinTheSonarsReach) {
  Navdata message;
  EXPECT_FALSE(toHeightReading(message).value) << "no stamp";
  message.header.stamp.fromNSec(5'000'000'000);
  HeightInputConfig config;
  config.use_navdata_height = true;
  HeightInput input(config, 10);
  const auto push = [&](int altitude_mm) {
    message.altd = altitude_mm;
    message.header.stamp += ros::Duration(0.005);
    return input.push(*toHeightReading(message).value);
  };
  EXPECT_EQ(push(850), HeightInput::Push::kAccepted);
  EXPECT_EQ(push(0), HeightInput::Push::kOutOfRange) << "on the ground";
  EXPECT_EQ(push(-3), HeightInput::Push::kOutOfRange);
  EXPECT_EQ(push(9000), HeightInput::Push::kOutOfRange);
  OdometryState upright;
  upright.stamp_ns = 5'005'000'000;
  EXPECT_NEAR(*input.at(upright), 0.85, 1e-9);
}

BagReadOptions frontCamera() {
  BagReadOptions options;
  options.image_topic = "/ardrone/front/image_raw";
  return options;
}

TEST(DriverNavdata, TakesTheOdometrysPlaceInABag) {
  const DriverRecording recording(driverFaultsNamed({"released"}), "truth");
  BagReadOptions options = frontCamera();
  options.odometry_mode = OdometryMode::kNavdata;
  const auto bag = openBag(recording.path(), options);
  const auto& states = bag->odometry();
  ASSERT_EQ(states.size(), recording.read<Navdata>("/ardrone/navdata").size());
  EXPECT_GT(bag->odometryInputFaults()[static_cast<std::size_t>(OdometryFault::kBurst)], 0U);
  const Eigen::Vector3d begin_m = bag->truth().at(states.front().stamp_ns).translation();
  for (std::size_t i = 1; i < states.size(); ++i) {
    ASSERT_GT(states[i].stamp_ns, states[i - 1].stamp_ns);
    Eigen::Vector3d truth_m = bag->truth().at(states[i].stamp_ns).translation();
    truth_m.head<2>() -= begin_m.head<2>();
    EXPECT_LT((states[i].T_odom_base.translation() - truth_m).norm(), 0.02) << i;
    EXPECT_TRUE(positionVariance_m2(states[i]));
  }
  EXPECT_FALSE(states.back().twist_base.tail<3>().isZero(0)) << "the IMU's";
  EXPECT_EQ(openBag(recording.path(), frontCamera())->odometryInputFaults(), OdometryFaultCounts{});
}

TEST(DriverNavdata, HeightsAreReadWhereTheyAreAskedFor) {
  const DriverRecording recording(driverFaultsNamed({"released"}), "truth");
  BagReadOptions options = frontCamera();
  EXPECT_TRUE(openBag(recording.path(), options)->ranges().empty());
  options.use_navdata_height = true;
  const auto bag = openBag(recording.path(), options);
  EXPECT_EQ(bag->ranges().size(), recording.read<Navdata>("/ardrone/navdata").size());
  std::size_t near = 0;  // the fused altitude lags where the drone climbs
  for (const RangeReading& height : bag->ranges()) {
    const double z_m = bag->truth().at(height.stamp_ns).translation().z();
    near += std::abs(height.range_m - z_m) < 0.1;
  }
  EXPECT_GT(near, bag->ranges().size() / 2);
}

TEST(DriverNavdata, ABagWithoutIsRefusedByName) {
  const DriverRecording recording({});
  BagReadOptions options = frontCamera();
  options.odometry_mode = OdometryMode::kNavdata;
  options.navdata_topic = "/ardrone/odometry";
  try {
    openBag(recording.path(), options);
    FAIL() << "not refused";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("ardrone_autonomy/Navdata"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace ardrone_vslam
