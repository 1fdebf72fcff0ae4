// SPDX-License-Identifier: BSD-3-Clause
// doctor on bags: names each fault of the driver, and nothing else; stands bags that lack things.
#include "doctor_bag.hpp"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "ardrone_vslam/rotation.hpp"
#include "bag_recipe.hpp"
#include "doctor_examination.hpp"
#include "driver_recording.hpp"

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

DoctorReport examineBag(const std::string& path) {
  return examine(readForDoctor(path, {}, {}), {});
}

/// A flight as the driver records it, 8 images a second.
class DriverFlight {
 public:
  DriverFlight(const std::string& flight, double seconds) : world_(options(flight, seconds)) {}

  void write(const DriverFaults& faults, const std::string& path) const {
    DriverBagOptions options;
    options.faults = faults;
    options.profile =
        loadObserverProfile("drone", ARDRONE_VSLAM_SOURCE_DIR "/config/observer_profiles.yaml");
    options.tool = "test";
    writeDriverBag(world_, options, path);
  }

 private:
  static WorldOptions options(const std::string& flight, double seconds) {
    WorldOptions options;
    options.flight = flight;
    options.duration_s = seconds;
    options.rate_hz = 8;
    return options;
  }
  WorldSequence world_;
};

class DoctorBag : public testing::Test {
 protected:
  /// Painted once.
  static const DriverFlight& laps() {
    static const DriverFlight flight("laps", 10);
    return flight;
  }
  /// Long enough to tell the time offset.
  static const DriverFlight& longLaps() {
    static const DriverFlight flight("laps", 24);
    return flight;
  }
  std::string path(const std::string& name = "driver.bag") const { return folder_.file(name); }
  DoctorReport examineFlight(const DriverFaults& faults,
                             const DriverFlight& flight = laps()) const {
    flight.write(faults, path());
    return examineBag(path());
  }
  TemporaryFolder folder_;
};

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

/// A bag's copy without odometry, as of a driver that was not asked for it.
void dropOdometry(const std::string& from, const std::string& to) {
  const rosbag::Bag source(from, rosbag::bagmode::Read);
  rosbag::Bag copy(to, rosbag::bagmode::Write);
  rosbag::View view(source);
  for (const rosbag::MessageInstance& instance : view) {
    if (!instance.isType<nav_msgs::Odometry>())
      copy.write(instance.getTopic(), instance.getTime(), instance);
  }
  copy.close();
}

/// A bag's copy with the cameras turned by `turn` in tf.
void turnCameras(const std::string& from, const std::string& to, const Eigen::Matrix3d& turn) {
  const rosbag::Bag source(from, rosbag::bagmode::Read);
  rosbag::Bag copy(to, rosbag::bagmode::Write);
  rosbag::View view(source);
  for (const rosbag::MessageInstance& instance : view) {
    const auto tf = instance.instantiate<tf2_msgs::TFMessage>();
    if (!tf) {
      copy.write(instance.getTopic(), instance.getTime(), instance);
      continue;
    }
    for (auto& transform : tf->transforms) {
      if (transform.child_frame_id.find("cam") == std::string::npos) continue;
      const auto& q = transform.transform.rotation;
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * turn;
      transform.transform.rotation = toPoseMessage(T).orientation;
    }
    copy.write(instance.getTopic(), instance.getTime(), *tf);
  }
  copy.close();
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

class DoctorTool : public DoctorBag {
 protected:
  int run(const std::string& arguments) const {
    const std::string command =
        ARDRONE_VSLAM_DOCTOR " " + arguments + " > " + path("output") + " 2> " + path("errors");
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string output() const { return readWhole(path("output")); }
  std::string errors() const { return readWhole(path("errors")); }
};

TEST_F(DoctorTool, ExitCodesTellUsableFromNotAndFromWrongUsage) {
  laps().write(driverFaultsNamed({"released"}), path());
  EXPECT_EQ(run(path() + " --json " + path("report.json")), 0) << errors();
  EXPECT_NE(output().find("observer_mode: twist"), std::string::npos) << output();
  const auto json = nlohmann::json::parse(readWhole(path("report.json")));
  EXPECT_TRUE(json["usable"].get<bool>());
  EXPECT_EQ(run(path() + " --json -"), 0);
  EXPECT_EQ(nlohmann::json::parse(output()), json);

  BagRecipe no_tf;
  no_tf.has_tf = false;
  EXPECT_EQ(run(TestBag(no_tf).path()), 1);
  EXPECT_NE(output().find("cannot work as it is"), std::string::npos);
  EXPECT_EQ(run(path() + " --image /none"), 1);
  EXPECT_NE(errors().find("/none"), std::string::npos);
  folder_.write("empty.bag", "");
  EXPECT_EQ(run(path("empty.bag")), 1);
  EXPECT_NE(errors().find("is empty"), std::string::npos) << errors();
  EXPECT_EQ(run(path("missing.bag")), 1);
  EXPECT_NE(errors().find("no such file"), std::string::npos) << errors();

  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run(path() + " --live"), 2);
  EXPECT_EQ(run(path() + " --seconds 5"), 2);
  EXPECT_EQ(run(path() + " --no-such-option"), 2);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_EQ(run("--version"), 0);
}

TEST_F(DoctorTool, NavdataWithoutOdometryIsUsableAndItsReplayLineRuns) {
  laps().write({}, path("whole.bag"));
  dropOdometry(path("whole.bag"), path());
  EXPECT_EQ(run(path() + " --json " + path("report.json")), 0) << output() << errors();
  EXPECT_NE(output().find("observer_mode: navdata"), std::string::npos) << output();
  const auto json = nlohmann::json::parse(readWhole(path("report.json")));
  EXPECT_EQ(json["parameters"]["mapper/observer_mode"]["value"], "navdata");
  for (const auto& check : json["checks"]) {
    if (check["check"] == "topics" || check["verdict"] == "not checked") continue;
    EXPECT_EQ(check["verdict"], "ok") << check;
  }
  std::string line = json["replay"];
  const auto replaced = [&line](const std::string& from, const std::string& to) {
    const auto at = line.find(from);
    ASSERT_NE(at, std::string::npos) << line;
    line.replace(at, from.size(), to);
  };
  replaced("rosrun ardrone_vslam replay", ARDRONE_VSLAM_REPLAY);
  replaced("$(rospack find ardrone_vslam)", ARDRONE_VSLAM_SOURCE_DIR);
  replaced("--out driver_run", "--frames 0:20 --out " + path("run"));
  line += " > " + path("output") + " 2> " + path("errors");
  EXPECT_EQ(std::system(line.c_str()), 0) << line << "\n" << errors();
}

TEST_F(DoctorTool, ReplayOfATurnedCameraNamesDoctorAndThatOfASoundOneDoesNot) {
  longLaps().write(driverFaultsNamed({"released"}), path());
  turnCameras(path(), path("turned.bag"), rotationOf(Eigen::Vector3d(0, 0, M_PI)));
  const auto replay = [this](const std::string& name) {
    const std::string command = ARDRONE_VSLAM_REPLAY " " + path(name) + " --out " + path("run") +
                                " --config " ARDRONE_VSLAM_SOURCE_DIR "/config/ardrone.yaml > " +
                                path("output") + " 2> " + path("errors");
    EXPECT_EQ(std::system(command.c_str()), 0) << errors();
    return errors();
  };
  EXPECT_NE(replay("turned.bag").find("rosrun ardrone_vslam doctor " + path("turned.bag")),
            std::string::npos)
      << errors();
  EXPECT_EQ(replay("driver.bag").find("rosrun ardrone_vslam doctor"), std::string::npos)
      << errors();
}

TEST_F(DoctorTool, WithoutAMasterLiveSaysSo) {
  EXPECT_EQ(std::system(("ROS_MASTER_URI=http://localhost:9 " ARDRONE_VSLAM_DOCTOR
                         " --live --seconds 1 2> " +
                         path("errors") + " > " + path("output"))
                            .c_str()) >>
                8,
            1);
  EXPECT_NE(errors().find("no ROS master"), std::string::npos) << errors();
}

}  // namespace
}  // namespace ardrone_vslam
