// SPDX-License-Identifier: BSD-3-Clause
// doctor on bags: names each fault of the driver, and nothing else; stands bags that lack things.
#include "doctor/collection/doctor_bag.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ardrone_vslam/rotation.hpp"
#include "bag_recipe.hpp"
#include "config_files/config_file.hpp"
#include "config_files/config_path.hpp"
#include "doctor/doctor_examination.hpp"
#include "doctor_flights.hpp"
#include "support/doctor_findings.hpp"
#include "support/read_file.hpp"

namespace ardrone_vslam {
namespace {

using Names = std::set<std::string>;
using test::found;

std::set<Verdict> verdictsOf(const DoctorReport& report, const std::string& check) {
  std::set<Verdict> verdicts;
  for (const Finding& finding : report.findings) {
    if (finding.check == check) verdicts.insert(finding.verdict);
  }
  return verdicts;
}

/// What replay runs with by the report's command.
PipelineConfig configOf(const DoctorReport& report) {
  std::vector<std::string> overrides;
  for (const SuggestedParameter& p : report.parameters)
    overrides.push_back(p.section + "/" + p.key + "=" + p.value);
  return loadConfig(findConfigFile(report.config_file), overrides);
}

TEST_F(DoctorBag, TheDriverWithoutFaultsHasNone) {
  const DoctorReport report = examineFlight({}, longLaps());
  for (const Finding& finding : report.findings) {
    EXPECT_EQ(finding.verdict, Verdict::kOk) << finding.check << ": " << finding.text;
  }
  EXPECT_EQ(report.config_file, "ardrone.yaml");
  // All that has to be changed of what is made for the released driver.
  ASSERT_EQ(report.parameters.size(), 2U) << textOf(report);
  for (const SuggestedParameter& parameter : report.parameters) {
    EXPECT_EQ(parameter.key + "=" + parameter.value, "image_time_offset_s=0");
  }
  EXPECT_NE(report.parameters[0].section, report.parameters[1].section);
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
    EXPECT_EQ(found(report.findings), wanted.at(info.fault)) << info.name << "\n" << textOf(report);
    EXPECT_TRUE(report.canWork()) << info.name;
    EXPECT_NE(report.replay.find("/config/ardrone.yaml"), std::string::npos) << report.replay;
  }
}

TEST_F(DoctorBag, NamesAllFaultsTogether) {
  // What shows behind whole metres needs a table.
  const Names wanted{"odometry_yaw",       "odometry_jumps", "odometry_covariance",
                     "odometry_turn_rate", "height_metres",  "odometry_frames",
                     "odometry_bursts",    "navdata_bursts", "imu_bursts",
                     "calibration",        "camera_switch"};
  const DoctorReport report = examineFlight(driverFaultsNamed({"all"}));
  EXPECT_EQ(found(report.findings), wanted);
  EXPECT_TRUE(report.canWork()) << textOf(report);
  // K is rescaled, so that the camera is looked at.
  EXPECT_EQ(verdictsOf(report, "images_tracked"), std::set<Verdict>{Verdict::kOk});
  EXPECT_EQ(verdictsOf(report, "camera_direction").count(Verdict::kNotChecked), 0U)
      << textOf(report);
  DriverFlight("table", 30).write(driverFaultsNamed({"all"}), path());
  const Names over_table = found(examineBag(path()).findings);
  EXPECT_EQ(over_table.count("height_metres"), 1U);
  EXPECT_EQ(over_table.count("height_ground"), 1U);
}

TEST_F(DoctorBag, NamesTheReleasedDriversFaultsAndSuggestsTheirRemedies) {
  const DoctorReport report = examineFlight(driverFaultsNamed({"released"}), longLaps());
  EXPECT_EQ(found(report.findings),
            (Names{"odometry_yaw", "odometry_covariance", "odometry_turn_rate", "height_ground",
                   "odometry_bursts", "navdata_bursts", "imu_bursts", "image_time_offset"}))
      << textOf(report);
  EXPECT_TRUE(report.canWork());
  // The configuration made for the driver has them all.
  EXPECT_EQ(report.config_file, "ardrone.yaml");
  EXPECT_TRUE(report.parameters.empty()) << textOf(report);
  std::map<std::string, std::string> values;
  for (const auto& parameter : report.configured) values[parameter.key] = parameter.value;
  EXPECT_EQ(values["odometry_mode"], "twist");
  // The video is 75 to 100 ms late.
  EXPECT_NEAR(std::stod(values["image_time_offset_s"]), -0.0875, 0.01);
  const PipelineConfig config = configOf(report);
  EXPECT_EQ(config.mapper.odometry_adapter.mode, OdometryMode::kTwist);
  EXPECT_NEAR(config.mapper.image_time_offset_s.value(), -0.0875, 0.01);
}

TEST_F(DoctorBag, WhatTheConfigurationInForceAnswersIsNoWarningAndTheRestIs) {
  longLaps().write(driverFaultsNamed({"released"}), path());
  const auto examineWith = [this](const std::string& file) {
    return examine(readForDoctor(path(), {}, {}), {}, configurationOfFile(findConfigFile(file)));
  };
  const DoctorReport made_for_it = examineWith("ardrone.yaml");
  // Of the driver itself; no parameter changes it.
  const Names left{"odometry_turn_rate", "odometry_bursts", "navdata_bursts", "imu_bursts"};
  EXPECT_EQ(found(made_for_it.findings), left) << textOf(made_for_it);
  for (const std::string answered :
       {"odometry_yaw", "odometry_covariance", "height_ground", "image_time_offset"}) {
    EXPECT_EQ(test::verdictOf(made_for_it.findings, answered), Verdict::kConfigured) << answered;
  }
  const std::string remedy = test::findingOf(made_for_it.findings, "odometry_yaw").remedy;
  EXPECT_NE(remedy.find("config/ardrone.yaml has mapper/odometry_mode: twist"), std::string::npos)
      << remedy;

  // One that is not: the noise is its own all the same, and the rest is to be changed in it.
  const DoctorReport another = examineWith("kitti.yaml");
  Names all = left;
  all.insert({"odometry_yaw", "height_ground", "image_time_offset"});
  EXPECT_EQ(found(another.findings), all) << textOf(another);
  EXPECT_NE(another.replay.find("config/kitti.yaml "), std::string::npos) << another.replay;
  EXPECT_NE(another.replay.find(" --set mapper/odometry_mode=twist"), std::string::npos)
      << another.replay;
}

TEST_F(DoctorBag, AFlightTooShortToTellTheDriversFaultsGetsItsConfigurationAllTheSame) {
  DriverFlight("laps", 3).write(driverFaultsNamed({"all"}), path());
  const DoctorReport report = examineBag(path());
  EXPECT_EQ(found(report.findings).count("odometry_yaw"), 0U) << textOf(report);
  EXPECT_TRUE(report.canWork()) << textOf(report);
  const PipelineConfig config = configOf(report);
  EXPECT_EQ(config.mapper.odometry_adapter.mode, OdometryMode::kTwist);
  EXPECT_TRUE(config.rescale_calibration);
  EXPECT_TRUE(config.mapper.height_input.use_navdata_height);
}

TEST_F(DoctorBag, FindsATurnedCameraAndPrintsTheRightTransform) {
  laps().write(driverFaultsNamed({"released"}), path());
  const std::string wanted =
      "rosrun tf2_ros static_transform_publisher 0.21 0 0 -1.5708 0 -1.5708 ardrone_base_link "
      "ardrone_base_frontcam";
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0, 0, M_PI), Eigen::Vector3d(0, M_PI, 0), Eigen::Vector3d(M_PI / 2, 0, 0),
        Eigen::Vector3d(0, 0, -M_PI / 2)}) {
    rotateCameras(path(), path("turned.bag"), rotationOf(turn));
    const DoctorReport report = examineBag(path("turned.bag"));
    EXPECT_EQ(found(report.findings).count("camera_direction"), 1U) << turn.transpose();
    EXPECT_FALSE(report.canWork());
    EXPECT_EQ(report.static_transform, wanted) << turn.transpose();
  }
}

TEST_F(DoctorBag, StandsBagsThatLackThings) {
  BagRecipe no_tf;
  no_tf.has_tf = false;
  EXPECT_EQ(found(examineBag(TestBag(no_tf).path()).findings).count("camera_tf"), 1U);
  BagRecipe no_info;
  no_info.has_camera_info = false;
  EXPECT_EQ(found(examineBag(TestBag(no_info).path()).findings).count("topics"), 1U);
  BagRecipe no_odometry;
  no_odometry.odometry.clear();
  EXPECT_EQ(found(examineBag(TestBag(no_odometry).path()).findings).count("topics"), 1U);
  BagRecipe no_images;
  no_images.image_stamps_s.clear();
  EXPECT_EQ(found(examineBag(TestBag(no_images).path()).findings).count("topics"), 1U);
  BagRecipe uncalibrated;
  uncalibrated.camera_info.K.fill(0);
  EXPECT_EQ(found(examineBag(TestBag(uncalibrated).path()).findings).count("calibration"), 1U);
  BagRecipe other_lens;
  other_lens.camera_info.distortion_model = "equidistant";
  EXPECT_EQ(found(examineBag(TestBag(other_lens).path()).findings).count("calibration"), 1U);
  BagRecipe depth;
  depth.encoding = "mono16";
  EXPECT_NO_THROW(examineBag(TestBag(depth).path()));
  for (const BagRecipe& recipe : {no_tf, uncalibrated, other_lens}) {
    EXPECT_FALSE(examineBag(TestBag(recipe).path()).canWork());
  }
}

TEST_F(DoctorBag, DamagedBagsAreNoCrash) {
  const TestBag bag{BagRecipe()};
  const std::string whole = test::readFile(bag.path());
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
