// SPDX-License-Identifier: BSD-3-Clause
// doctor as a program: exit codes, what it prints, and that its replay command runs.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "ardrone_vslam/rotation.hpp"
#include "bag_recipe.hpp"
#include "doctor_flights.hpp"
#include "support/read_file.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class DoctorTool : public DoctorBag {
 protected:
  int run(const std::string& arguments) const {
    const std::string command = test::program("doctor") + " " + arguments + " > " + path("output") +
                                " 2> " + path("errors");
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// Of a bag's first images.
  void expectToRun(std::string line) const {
    const auto replaced = [&line](const std::string& from, const std::string& to) {
      const auto at = line.find(from);
      ASSERT_NE(at, std::string::npos) << line;
      line.replace(at, from.size(), to);
    };
    replaced("rosrun ardrone_vslam replay", test::program("replay"));
    if (line.find("$(rospack") != std::string::npos)
      replaced("$(rospack find ardrone_vslam)/", test::packageFile(""));
    replaced("--out driver_run", "--frames 0:20 --out " + path("run"));
    line += " > " + path("output") + " 2> " + path("errors");
    EXPECT_EQ(std::system(line.c_str()), 0) << line << "\n" << errors();
  }
  std::string output() const { return test::readFile(path("output")); }
  std::string errors() const { return test::readFile(path("errors")); }
};

TEST_F(DoctorTool, ExitCodesTellUsableFromNotAndFromWrongUsage) {
  laps().write(driverFaultsNamed({"released"}), path());
  EXPECT_EQ(run(path() + " --json " + path("report.json")), 0) << errors();
  EXPECT_NE(output().find("set odometry_mode to twist"), std::string::npos) << output();
  EXPECT_NE(output().find("config/ardrone.yaml, which has mapper/odometry_mode"), std::string::npos)
      << output();
  const auto json = nlohmann::json::parse(test::readFile(path("report.json")));
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

TEST_F(DoctorTool, ConfigTakesAFileAsReplayDoesAndRefusesAWrongOne) {
  laps().write(driverFaultsNamed({"released"}), path());
  const std::string config = test::packageFile("config/ardrone.yaml");
  EXPECT_EQ(run(path() + " --config " + config + " --json " + path("report.json")), 0) << errors();
  EXPECT_NE(output().find("In force: " + config + ", which has mapper/odometry_mode"),
            std::string::npos)
      << output();
  expectToRun(nlohmann::json::parse(test::readFile(path("report.json")))["replay"]);
  folder_.write("wrong.yaml", "mapper:\n  odometry_mod: twist\n");
  EXPECT_NE(run(path() + " --config " + path("wrong.yaml")), 0);
  EXPECT_NE(errors().find("odometry_mod is not a parameter"), std::string::npos) << errors();
}

TEST_F(DoctorTool, NavdataWithoutOdometryIsUsableAndItsReplayLineRuns) {
  laps().write({}, path("whole.bag"));
  dropOdometry(path("whole.bag"), path());
  EXPECT_EQ(run(path() + " --json " + path("report.json")), 0) << output() << errors();
  EXPECT_NE(output().find("odometry_mode: navdata"), std::string::npos) << output();
  const auto json = nlohmann::json::parse(test::readFile(path("report.json")));
  EXPECT_EQ(json["parameters"]["mapper/odometry_mode"]["value"], "navdata");
  for (const auto& check : json["checks"]) {
    if (check["check"] == "topics" || check["verdict"] == "not checked") continue;
    EXPECT_EQ(check["verdict"], "ok") << check;
  }
  expectToRun(json["replay"]);
}

TEST_F(DoctorTool, AllFaultsOfTheDriverAreUsableAndTheReplayLineRuns) {
  laps().write(driverFaultsNamed({"all"}), path());
  EXPECT_EQ(run(path() + " --json " + path("report.json")), 0) << output() << errors();
  expectToRun(nlohmann::json::parse(test::readFile(path("report.json")))["replay"]);
}

TEST_F(DoctorTool, ReplayOfATurnedCameraNamesDoctorAndThatOfASoundOneDoesNot) {
  longLaps().write(driverFaultsNamed({"released"}), path());
  rotateCameras(path(), path("turned.bag"), rotationOf(Eigen::Vector3d(0, 0, M_PI)));
  const auto replay = [this](const std::string& name) {
    const std::string command =
        test::program("replay") + " " + path(name) + " --out " + path("run") + " --config " +
        test::packageFile("config/ardrone.yaml") + " > " + path("output") + " 2> " + path("errors");
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
  EXPECT_EQ(std::system(("ROS_MASTER_URI=http://localhost:9 " + test::program("doctor") +
                         " --live --seconds 1 2> " + path("errors") + " > " + path("output"))
                            .c_str()) >>
                8,
            1);
  EXPECT_NE(errors().find("no ROS master"), std::string::npos) << errors();
}

TEST_F(DoctorTool, PrintsTheExampleOfItsPage) {
  const std::string page = test::readFile(test::packageFile("docs/doctor.md"));
  const auto example = page.find("## Example\n");
  ASSERT_NE(example, std::string::npos);
  const auto between = [&](const std::string& before, const std::string& after) {
    const auto begin = page.find(before, example) + before.size();
    return page.substr(begin, page.find(after, begin) - begin);
  };
  const std::string in_folder = "cd " + path("") + " && ";
  const std::string make_world = in_folder + test::program("make_world") + " " +
                                 between("`make_world ", "`:") + " > output 2>&1";
  ASSERT_EQ(std::system(make_world.c_str()), 0) << make_world << "\n" << output();
  const std::string doctor = in_folder + test::program("doctor") + " FILE.bag > output 2> errors";
  ASSERT_EQ(std::system(doctor.c_str()), 0) << errors();
  EXPECT_EQ(output(), between("`:\n```\n", "```"));
}

}  // namespace
}  // namespace ardrone_vslam
