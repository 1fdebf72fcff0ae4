// SPDX-License-Identifier: BSD-3-Clause
// doctor on bags: names each fault of the driver, and nothing else; stands bags that lack things.
#include "doctor_bag.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ardrone_vslam/rotation.hpp"
#include "bag_recipe.hpp"
#include "doctor_examination.hpp"
#include "doctor_flights.hpp"

namespace ardrone_vslam {
namespace {

using Names = std::set<std::string>;

/// Checks that found something.
Names found(const DoctorReport& report) {
  Names names;
  for (const Finding& finding : report.findings) {
    const bool is_found =
        finding.verdict == Verdict::kWarning || finding.verdict == Verdict::kFault;
    if (is_found) names.insert(finding.check);
  }
  return names;
}

TEST_F(DoctorBag, TheDriverWithoutFaultsHasNone) {
  const DoctorReport report = examineFlight({}, longLaps());
  for (const Finding& finding : report.findings) {
    EXPECT_EQ(finding.verdict, Verdict::kOk) << finding.check << ": " << finding.text;
  }
  EXPECT_EQ(report.config_file, "ardrone_front.yaml");
  EXPECT_TRUE(report.parameters.empty());
}

TEST_F(DoctorBag, NamesEachFaultOfTheDriverAndNothingElse) {
  const std::map<DriverFault, Names> wanted{
      {DriverFault::kMirroredYaw, {"odometry_yaw"}},
      {DriverFault::kEpochDt, {"odometry_jumps"}},
      {DriverFault::kZeroCovariance, {"odometry_covariance", "odometry_turn_rate"}},
      {DriverFault::kFusedAltitude, {"height_ground"}},
      {DriverFault::kWholeMetres, {"height_metres"}},
      {DriverFault::kUnprefixedFrame, {"odometry_frames"}},
      {DriverFault::kBursts, {"odometry_bursts", "navdata_bursts", "imu_bursts"}},
      {DriverFault::kUnscaledCameraInfo, {"calibration"}},
      {DriverFault::kTogglecam, {"camera_switch"}},
  };
  ASSERT_EQ(wanted.size(), driverFaults().size());
  for (const DriverFaultInfo& info : driverFaults()) {
    const DoctorReport report = examineFlight({info.fault});
    EXPECT_EQ(found(report), wanted.at(info.fault)) << info.name << "\n" << textOf(report);
    EXPECT_EQ(report.canWork(), info.fault != DriverFault::kUnscaledCameraInfo) << info.name;
  }
}

TEST_F(DoctorBag, NamesAllFaultsTogether) {
  // What shows behind whole metres needs a table, what shows in the tracks a calibration.
  const Names wanted{"odometry_yaw",       "odometry_jumps", "odometry_covariance",
                     "odometry_turn_rate", "height_metres",  "odometry_frames",
                     "odometry_bursts",    "navdata_bursts", "imu_bursts",
                     "calibration",        "camera_switch"};
  EXPECT_EQ(found(examineFlight(driverFaultsNamed({"all"}))), wanted);
  DriverFlight("table", 30).write(driverFaultsNamed({"all"}), path());
  const Names over_table = found(examineBag(path()));
  EXPECT_EQ(over_table.count("height_metres"), 1U);
  EXPECT_EQ(over_table.count("height_ground"), 1U);
}

TEST_F(DoctorBag, NamesTheReleasedDriversFaultsAndSuggestsTheirRemedies) {
  const DoctorReport report = examineFlight(driverFaultsNamed({"released"}), longLaps());
  EXPECT_EQ(found(report),
            (Names{"odometry_yaw", "odometry_covariance", "odometry_turn_rate", "height_ground",
                   "odometry_bursts", "navdata_bursts", "imu_bursts", "image_time_offset"}))
      << textOf(report);
  EXPECT_TRUE(report.canWork());
  std::map<std::string, std::string> values;
  for (const auto& parameter : report.parameters) values[parameter.key] = parameter.value;
  EXPECT_EQ(values["observer_mode"], "twist");
  // The video is 75 to 100 ms late.
  EXPECT_NEAR(std::stod(values["image_time_offset_s"]), -0.0875, 0.01);
}

TEST_F(DoctorBag, FindsATurnedCameraAndPrintsTheRightTransform) {
  laps().write(driverFaultsNamed({"released"}), path());
  const std::string wanted =
      "rosrun tf2_ros static_transform_publisher 0.21 0 0 -1.5708 0 -1.5708 ardrone_base_link "
      "ardrone_base_frontcam";
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0, 0, M_PI), Eigen::Vector3d(0, M_PI, 0), Eigen::Vector3d(M_PI / 2, 0, 0),
        Eigen::Vector3d(0, 0, -M_PI / 2)}) {
    turnCameras(path(), path("turned.bag"), rotationOf(turn));
    const DoctorReport report = examineBag(path("turned.bag"));
    EXPECT_EQ(found(report).count("camera_direction"), 1U) << turn.transpose();
    EXPECT_FALSE(report.canWork());
    EXPECT_EQ(report.static_transform, wanted) << turn.transpose();
  }
}

TEST_F(DoctorBag, StandsBagsThatLackThings) {
  BagRecipe no_tf;
  no_tf.has_tf = false;
  EXPECT_EQ(found(examineBag(TestBag(no_tf).path())).count("camera_tf"), 1U);
  BagRecipe no_info;
  no_info.has_camera_info = false;
  EXPECT_EQ(found(examineBag(TestBag(no_info).path())).count("topics"), 1U);
  BagRecipe no_odometry;
  no_odometry.odometry.clear();
  EXPECT_EQ(found(examineBag(TestBag(no_odometry).path())).count("topics"), 1U);
  BagRecipe no_images;
  no_images.image_stamps_s.clear();
  EXPECT_EQ(found(examineBag(TestBag(no_images).path())).count("topics"), 1U);
  BagRecipe uncalibrated;
  uncalibrated.camera_info.K.fill(0);
  EXPECT_EQ(found(examineBag(TestBag(uncalibrated).path())).count("calibration"), 1U);
  BagRecipe other_lens;
  other_lens.camera_info.distortion_model = "equidistant";
  EXPECT_EQ(found(examineBag(TestBag(other_lens).path())).count("calibration"), 1U);
  BagRecipe depth;
  depth.encoding = "mono16";
  EXPECT_NO_THROW(examineBag(TestBag(depth).path()));
  for (const BagRecipe& recipe : {no_tf, uncalibrated, other_lens}) {
    EXPECT_FALSE(examineBag(TestBag(recipe).path()).canWork());
  }
}

TEST_F(DoctorBag, DamagedBagsAreNoCrash) {
  const TestBag bag{BagRecipe()};
  const std::string whole = readWhole(bag.path());
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 97 + 1) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    folder_.write("damaged.bag", damaged);
    folder_.write("cut.bag", whole.substr(0, at));
    for (const std::string name : {"damaged.bag", "cut.bag"}) {
      try {
        examineBag(path(name));
      } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
      }
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
