// SPDX-License-Identifier: BSD-3-Clause
// doctor on the AR.Drone's navdata and IMU: each fault named, and nothing else.
#include "doctor/streams/doctor_navdata.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "doctor/doctor_examination.hpp"
#include "doctor/streams/doctor_streams.hpp"
#include "support/doctor_findings.hpp"
#include "support/doctor_recordings.hpp"

namespace ardrone_vslam {
namespace {

using test::findingOf;
using test::goodRecording;
using Names = std::set<std::string>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The good recording with navdata and IMU in place of the odometry.
DoctorRecording navdataRecording() {
  DoctorRecording recording = goodRecording();
  recording.odometry.clear();
  recording.odometry_topic.clear();
  recording.topics.erase("/odom");
  recording.topics["/ardrone/navdata"] = {"ardrone_autonomy/Navdata", 1200};
  recording.topics["/ardrone/imu"] = {"sensor_msgs/Imu", 1200};
  recording.navdata_topic = "/ardrone/navdata";
  recording.imu_topic = "/ardrone/imu";
  for (int i = 0; i < 1200; ++i) {
    const OdometryState state = test::doctorState(0.01 * i);
    NavdataReading packet;
    packet.stamp_ns = state.stamp_ns;
    packet.measured.R_odom_base = state.T_odom_base.linear();
    packet.measured.flow_base_m_s = state.twist_base.head<2>();
    packet.measured.force_base_m_s2 << 0, 0, 9.81;
    packet.measured.height_m = state.T_odom_base.translation().z();
    recording.navdata.push_back({{state.stamp_ns, state.stamp_ns}, packet});
    const DroneImu imu{state.stamp_ns, state.twist_base.tail<3>(), {0, 0, 9.81}};
    recording.imu.push_back({{state.stamp_ns, state.stamp_ns}, imu});
  }
  return recording;
}

Findings navdataFindings(const DoctorRecording& recording) {
  Findings findings = checkNavdataStreams(recording);
  for (const Finding& finding : checkNavdataValues(recording)) findings.push_back(finding);
  return findings;
}

/// Those that found something; each must say what to do.
Names found(const DoctorRecording& recording) {
  Names names;
  for (const Finding& finding : navdataFindings(recording)) {
    if (finding.verdict == Verdict::kOk) continue;
    names.insert(finding.check);
    EXPECT_FALSE(finding.remedy.empty()) << finding.check;
  }
  return names;
}

template <class Change>
DoctorRecording withNavdata(Change change) {
  DoctorRecording recording = navdataRecording();
  for (std::size_t i = 0; i < recording.navdata.size(); ++i)
    change(i, *recording.navdata[i].reading);
  return recording;
}

template <class Change>
DoctorRecording withImu(Change change) {
  DoctorRecording recording = navdataRecording();
  for (std::size_t i = 0; i < recording.imu.size(); ++i) change(i, *recording.imu[i].reading);
  return recording;
}

TEST(DoctorNavdata, WithoutFaultsHasNone) {
  const DoctorRecording good = navdataRecording();
  EXPECT_EQ(found(good), Names{});
  EXPECT_EQ(navdataFindings(good).size(), 11U);
  EXPECT_EQ(findingOf(navdataFindings(good), "navdata_rate").text, "100.0 Hz for 12.0 s");
  EXPECT_TRUE(navdataFindings(goodRecording()).empty());
}

TEST(DoctorNavdata, StandsInForOdometry) {
  const DoctorRecording recording = navdataRecording();
  EXPECT_TRUE(isNavdataTheOdometry(recording));
  const Finding topics = checkTopics(recording);
  EXPECT_EQ(topics.verdict, Verdict::kWarning);
  EXPECT_NE(topics.remedy.find("--set mapper/odometry_mode=navdata"), std::string::npos);
  const DoctorReport report = examine(recording, {});
  EXPECT_TRUE(report.canWork()) << textOf(report);
  ASSERT_FALSE(report.parameters.empty());
  EXPECT_EQ(report.parameters.front().value, "navdata");
  EXPECT_EQ(report.replay,
            "rosrun ardrone_vslam replay good.bag --out good_run --config $(rospack find "
            "ardrone_vslam)/config/ardrone.yaml --set mapper/odometry_mode=navdata");
  // It comes from the circle's side to the other one.
  const auto states = observeNavdata(recording).states;
  ASSERT_GT(states.size(), 1100U);
  double farthest_m = 0;
  for (const OdometryState& state : states)
    farthest_m = std::max(farthest_m, state.T_odom_base.translation().head<2>().norm());
  EXPECT_NEAR(farthest_m, 4, 1);
}

TEST(DoctorNavdata, FindsRatesAndStamps) {
  DoctorRecording slow = navdataRecording();
  for (std::size_t i = 0; i < 1200; ++i) {
    slow.navdata[i].time.stamp_ns = test::doctorStamp_ns(0.2 * static_cast<double>(i));
    slow.imu[i].time.stamp_ns = slow.navdata[i].time.stamp_ns;
  }
  EXPECT_EQ(found(slow), (Names{"navdata_rate", "imu_rate"}));
  DoctorRecording back = navdataRecording();
  back.navdata[500].time.stamp_ns = back.navdata[490].time.stamp_ns;
  back.imu[500].time.stamp_ns = back.imu[490].time.stamp_ns;
  EXPECT_EQ(found(back), (Names{"navdata_stamps", "imu_stamps"}));
  DoctorRecording bursts = navdataRecording();
  for (std::size_t i = 0; i < 1200; ++i) {
    bursts.navdata[i].time.stamp_ns = bursts.navdata[i - i % 4].time.stamp_ns;
    bursts.imu[i].time.stamp_ns = bursts.navdata[i].time.stamp_ns;
  }
  EXPECT_EQ(found(bursts), (Names{"navdata_bursts", "imu_bursts"}));
}

TEST(DoctorNavdata, FindsNumbersThatAreNone) {
  const auto navdata = withNavdata([](std::size_t i, NavdataReading& packet) {
    if (i % 10 == 0) packet.measured.flow_base_m_s.x() = kNan;
  });
  EXPECT_EQ(found(navdata), Names{"navdata_values"});
  EXPECT_NE(findingOf(navdataFindings(navdata), "navdata_values").text.find("120 of 1200"),
            std::string::npos);
  const auto imu = withImu([](std::size_t i, DroneImu& reading) {
    if (i % 10 == 0) reading.force_base_m_s2.z() = kNan;
  });
  EXPECT_EQ(found(imu), Names{"imu_values"});
  const auto none = withNavdata(
      [](std::size_t, NavdataReading& packet) { packet.measured.R_odom_base.setConstant(kNan); });
  EXPECT_EQ(findingOf(navdataFindings(none), "navdata_values").verdict, Verdict::kFault);
  EXPECT_FALSE(examine(none, {}).canWork());
}

TEST(DoctorNavdata, FindsZeros) {
  const auto zero = withNavdata([](std::size_t, NavdataReading& packet) { packet.measured = {}; });
  EXPECT_EQ(found(zero),
            (Names{"navdata_values", "navdata_height", "navdata_velocity", "imu_turn_rate"}));
  EXPECT_FALSE(examine(zero, {}).canWork());
  const auto imu = withImu([](std::size_t, DroneImu& reading) {
    reading.angular_rate_base_rad_s.setZero();
    reading.force_base_m_s2.setZero();
  });
  EXPECT_EQ(found(imu), (Names{"imu_values", "imu_turn_rate"}));
  EXPECT_TRUE(examine(imu, {}).canWork());
  const auto dark = withNavdata(
      [](std::size_t, NavdataReading& packet) { packet.measured.flow_base_m_s.setZero(); });
  EXPECT_EQ(found(dark), Names{"navdata_velocity"});
  const auto deaf =
      withNavdata([](std::size_t, NavdataReading& packet) { packet.measured.height_m = 0; });
  EXPECT_EQ(found(deaf), Names{"navdata_height"});
}

TEST(DoctorNavdata, FindsOtherUnits) {
  // As conversion by the right units reads what comes in others.
  const auto metres =
      withNavdata([](std::size_t, NavdataReading& packet) { packet.measured.height_m /= 1000; });
  EXPECT_EQ(found(metres), Names{"navdata_height"});
  const auto metres_per_second = withNavdata(
      [](std::size_t, NavdataReading& packet) { packet.measured.flow_base_m_s /= 1000; });
  EXPECT_EQ(found(metres_per_second), Names{"navdata_velocity"});
  const auto newton = withNavdata(
      [](std::size_t, NavdataReading& packet) { packet.measured.force_base_m_s2 *= 9.81; });
  EXPECT_EQ(found(newton), Names{"navdata_values"});
  const auto g = withImu([](std::size_t, DroneImu& reading) { reading.force_base_m_s2 /= 9.81; });
  EXPECT_EQ(found(g), Names{"imu_values"});
  const auto degrees = withImu(
      [](std::size_t, DroneImu& reading) { reading.angular_rate_base_rad_s *= 180 / M_PI; });
  EXPECT_EQ(found(degrees), Names{"imu_turn_rate"});
  const auto mirrored =
      withImu([](std::size_t, DroneImu& reading) { reading.angular_rate_base_rad_s *= -1; });
  EXPECT_EQ(found(mirrored), Names{"imu_turn_rate"});
}

TEST(DoctorNavdata, IsNoFaultWhereOdometryIsUsed) {
  DoctorRecording recording = navdataRecording();
  recording.navdata.clear();
  recording.imu.clear();
  EXPECT_FALSE(examine(recording, {}).canWork());
  recording.odometry = goodRecording().odometry;
  recording.odometry_topic = "/odom";
  EXPECT_EQ(found(recording), (Names{"navdata_rate", "imu_rate"}));
  EXPECT_TRUE(examine(recording, {}).canWork());
}

TEST(DoctorNavdata, WithoutImuIsWarnedOf) {
  DoctorRecording recording = navdataRecording();
  recording.imu.clear();
  recording.imu_topic.clear();
  EXPECT_EQ(found(recording), Names{"imu_rate"});
  EXPECT_TRUE(examine(recording, {}).canWork());
}

}  // namespace
}  // namespace ardrone_vslam
