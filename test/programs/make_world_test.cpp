// SPDX-License-Identifier: BSD-3-Clause
// Folders as make_world writes them, and the program itself.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "folders/tum_folder_writer.hpp"
#include "support/read_file.hpp"
#include "support/shipped_profiles.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"
#include "world/world_sequence.hpp"

namespace ardrone_vslam {
namespace {

namespace fs = std::filesystem;

class MakeWorld : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }

  /// Exit code of make_world with these arguments; what it prints goes to the file `output`.
  int run(const std::string& arguments) const {
    const std::string command =
        test::program("make_world") + " " + arguments + " > " + path("output") + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }

  std::string text(const std::string& name) const { return test::readFile(path(name)); }

 private:
  TemporaryFolder folder_;
};

WorldOptions fewImages() {
  WorldOptions options;
  options.duration_s = 2;
  options.rate_hz = 2;
  options.odometry = test::shippedProfile("wheel");
  return options;
}

TEST_F(MakeWorld, FolderHoldsWhatTheSequenceGives) {
  WorldSequence world(fewImages());  // base in the middle of the drone
  TumFolderOptions options;
  options.odometry_comment = "profile wheel, seed 0";
  std::size_t last_progress = 0;
  options.progress = [&](std::size_t done, std::size_t) { last_progress = done; };
  writeTumFolder(world, path("flight"), options);
  EXPECT_EQ(last_progress, 4U);
  EXPECT_FALSE(fs::exists(path("flight.part")));
  EXPECT_EQ(text("flight/times.txt"), "1.000000000\n1.500000000\n2.000000000\n2.500000000\n");
  EXPECT_NE(text("flight/camera.yaml").find("data: [-0.525, 0.274, 0, 0, 0]"), std::string::npos);
  EXPECT_NE(text("flight/odometry_tum.txt").find("# profile wheel, seed 0"), std::string::npos);
  const cv::Mat image = cv::imread(path("flight/image/000003.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(image.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(image, world.image(3), cv::NORM_INF), 0);

  const Trajectory T_world_cam = readTum(path("flight/poses_tum.txt"));
  ASSERT_EQ(T_world_cam.size(), 4U);
  EXPECT_TRUE(T_world_cam.poses()[3].T_frame_body.isApprox(
      world.truth().poses()[3].T_frame_body * world.T_base_cam(), 1e-7));
  const auto odometry = readTumPoses(path("flight/odometry_tum.txt"));
  ASSERT_EQ(odometry.size(), world.odometry().size());
  // The folder's base is the camera: 0.21 m before the drone's, with the same axes.
  EXPECT_TRUE(odometry[40].T_frame_body.isApprox(
      world.odometry()[40].T_odom_base * Eigen::Translation3d(0.21, 0, 0), 1e-7));
}

TEST_F(MakeWorld, RangesAreTheHeightAlongTheBeamAndAreReadAgain) {
  WorldOptions options = fewImages();
  options.T_base_cam = forwardCamera();
  EXPECT_TRUE(WorldSequence(options).ranges().empty());
  options.range_noise_m = 0;
  WorldSequence world(options);
  const std::vector<RangeReading> ranges = world.ranges();
  ASSERT_EQ(ranges.size(), 38U);  // 1.5 s, 25 a second
  const Eigen::Isometry3d T_map_base = world.truth().at(ranges[20].stamp_ns);
  EXPECT_NEAR((T_map_base * Eigen::Vector3d(0, 0, -ranges[20].range_m)).z(), 0, 1e-12);
  writeTumFolder(world, path("flight"));
  const auto read = select(openFolder(path("flight")), {1, {}, 1, false})->ranges();
  ASSERT_EQ(read.size(), 38U) << "those of the second before the first frame, too";
  EXPECT_EQ(read[20].stamp_ns, ranges[20].stamp_ns);
  EXPECT_NEAR(read[20].range_m, ranges[20].range_m, 1e-6);

  options.range_noise_m = 0.1;
  const std::vector<RangeReading> noisy = WorldSequence(options).ranges();
  double sum_m2 = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i)
    sum_m2 += std::pow(noisy[i].range_m - ranges[i].range_m, 2);
  EXPECT_NEAR(std::sqrt(sum_m2 / 38), 0.1, 0.04);
}

TEST_F(MakeWorld, FolderIsReadAgainAsItWas) {
  WorldOptions options = fewImages();
  options.T_base_cam = forwardCamera();
  options.odometry = test::shippedProfile("harsh");  // repeated stamps
  WorldSequence world(options);
  writeTumFolder(world, path("flight"));
  const auto read = openFolder(path("flight"));
  ASSERT_EQ(read->size(), world.size());
  EXPECT_EQ(read->camera(), world.camera());
  EXPECT_TRUE(read->T_base_cam().isApprox(world.T_base_cam()));
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(read->stamp_ns(i), world.stamp_ns(i));
    EXPECT_EQ(cv::norm(read->image(i), world.image(i), cv::NORM_INF), 0);
    EXPECT_TRUE(read->truth().poses()[i].T_frame_body.isApprox(
        world.truth().poses()[i].T_frame_body, 1e-8));
  }
  ASSERT_EQ(read->odometry().size(), world.odometry().size());
  for (std::size_t i = 0; i < world.odometry().size(); ++i) {
    EXPECT_EQ(read->odometry()[i].stamp_ns, world.odometry()[i].stamp_ns);
    EXPECT_TRUE(read->odometry()[i].T_odom_base.isApprox(world.odometry()[i].T_odom_base, 1e-7));
  }
}

TEST_F(MakeWorld, AFailingImageLeavesNothingBehind) {
  class Failing : public WorldSequence {
   public:
    using WorldSequence::WorldSequence;
    cv::Mat image(std::size_t index) override {
      if (index == 2) throw std::runtime_error("third image");
      return WorldSequence::image(index);
    }
  };
  Failing world(fewImages());
  EXPECT_THROW(writeTumFolder(world, path("flight")), std::runtime_error);
  EXPECT_FALSE(fs::exists(path("flight")));
  EXPECT_FALSE(fs::exists(path("flight.part")));
}

TEST_F(MakeWorld, TheSameArgumentsGiveTheSameBytes) {
  const std::string arguments =
      "laps --seconds 1 --rate 2 --odometry-profile harsh --seed 5 --world-seed 6 --start "
      "-0.5,1,0.5 "
      "--out ";
  ASSERT_EQ(run(arguments + path("a")), 0) << text("output");
  ASSERT_EQ(run(arguments + path("b/")), 0) << text("output");
  for (const char* name : {"image/000000.png", "image/000001.png", "times.txt", "camera.yaml",
                           "poses_tum.txt", "odometry_tum.txt"}) {
    EXPECT_FALSE(text(std::string("a/") + name).empty()) << name;
    EXPECT_EQ(text(std::string("a/") + name), text(std::string("b/") + name)) << name;
  }
  EXPECT_NE(text("a/odometry_tum.txt").find("profile harsh, seed 5, drawn scale error"),
            std::string::npos);
}

TEST_F(MakeWorld, WritesBagsWhereRosIs) {
  const std::string arguments = "laps --seconds 0.2 --rate 10 --out ";
  const int exit_code = run(arguments + path("a.bag"));
#if ARDRONE_VSLAM_MAKE_WORLD_WRITES_BAGS
  ASSERT_EQ(exit_code, 0) << text("output");
  EXPECT_NE(text("output").find("profile drone, seed 0"), std::string::npos);
  EXPECT_EQ(text("a.bag").substr(0, 12), "#ROSBAG V2.0");
  ASSERT_EQ(run(arguments + path("b.bag")), 0);
  EXPECT_EQ(text("a.bag"), text("b.bag"));
#else
  EXPECT_EQ(exit_code, 1);
  EXPECT_NE(text("output").find("built without ROS"), std::string::npos);
#endif
}

TEST_F(MakeWorld, ExitCodesTellUsageFromFaults) {
  const std::string brief = "laps --seconds 0.1 --rate 10 --out ";
  EXPECT_EQ(run("--help"), 0);
  EXPECT_NE(text("output").find("--odometry-profile"), std::string::npos);
  EXPECT_EQ(run("--version"), 0);
  EXPECT_NE(text("output").find("make_world (ardrone_vslam) "), std::string::npos);
  EXPECT_EQ(run("laps"), 2);
  EXPECT_EQ(run("loops --out " + path("x")), 2);
  EXPECT_EQ(run(brief + path("x") + " --odometry-profile mars"), 2);
  EXPECT_NE(text("output").find("known are truth, wheel, wheels, drone, hover, harsh"),
            std::string::npos);
  EXPECT_EQ(run(brief + path("x") + " --start 9,0,0"), 2);
  EXPECT_NE(text("output").find("0.5 m from the walls"), std::string::npos);
  for (const char* option : {"--seed", "--world-seed"}) {
    for (const char* value : {" -1", "=-1", " 1.5", " x"}) {
      EXPECT_EQ(run(brief + path("x") + " " + option + value), 2) << option << value;
      EXPECT_NE(text("output").find(option), std::string::npos) << text("output");
    }
  }
  for (const char* option : {"--compressed png", "--compressed raw", "--compression lz4"}) {
    EXPECT_EQ(run(brief + path("x") + " " + option), 2) << option;
    EXPECT_NE(text("output").find("for bags only"), std::string::npos) << text("output");
    EXPECT_NE(text("output").find("/x.bag"), std::string::npos) << text("output");
  }
  EXPECT_FALSE(fs::exists(path("x")));
  for (const char* start : {"1,2", "1,2,3,4", "a,b,c", "1 2 3"}) {
    EXPECT_EQ(run(brief + path("x") + " --start '" + start + "'"), 2) << start;
    EXPECT_NE(text("output").find("must be X,Y,YAW"), std::string::npos) << start;
  }
  EXPECT_EQ(run(brief + "/proc/nowhere/x"), 1);
  EXPECT_NE(text("output").find("/proc/nowhere/x"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("x")));
}

TEST_F(MakeWorld, ListsItsFlights) {
  ASSERT_EQ(run("--list"), 0);
  const std::string list = text("output");
  const std::string docs = test::readFile(test::packageFile("docs/make_world.md"));
  for (const auto& flight : flights()) {
    EXPECT_NE(list.find(flight.name + " "), std::string::npos) << flight.name;
    EXPECT_NE(list.find(flight.summary), std::string::npos) << flight.name;
    EXPECT_NE(docs.find("| `" + flight.name + "` |"), std::string::npos) << flight.name;
  }
}

TEST_F(MakeWorld, OptionsOfWorldAndCameraChangeTheImages) {
  const std::string brief = "hover --seconds 0.1 --rate 10 --force --out " + path("flight") + " ";
  const auto firstImage = [&](const std::string& options) {
    EXPECT_EQ(run(brief + options), 0) << text("output");
    return cv::imread(path("flight/image/000000.png"), cv::IMREAD_UNCHANGED);
  };
  const cv::Mat usual = firstImage("");
  for (const char* options :
       {"--world room", "--light moving", "--gain 0.5", "--gain auto", "--image-noise 8",
        "--artefacts 30", "--camera front_wide", "--world-seed 4"}) {
    const cv::Mat other = firstImage(options);
    ASSERT_EQ(other.size(), usual.size());
    EXPECT_GT(cv::norm(usual, other, cv::NORM_L1), 0.5 * 640 * 360) << options;
  }
  EXPECT_EQ(firstImage("--camera bottom").size(), cv::Size(320, 240));
  EXPECT_NE(text("flight/camera.yaml").find("image_width: 320"), std::string::npos);
  // At rest neither a rolling nor a slow shutter shows.
  EXPECT_LT(cv::norm(usual, firstImage("--shutter 20 --readout 25"), cv::NORM_L1),
            0.01 * 640 * 360);
  for (const char* wrong :
       {"--gain 0", "--gain bright", "--gain 2x", "--artefacts 52", "--camera side",
        "--light disco", "--world corridor", "--shutter -1", "--camera bottom --range-noise 0.1"}) {
    EXPECT_EQ(run(brief + wrong), 2) << wrong << text("output");
  }
}

TEST_F(MakeWorld, ForceReplacesAFlightAndNothingElse) {
  const std::string brief = "laps --seconds 0.1 --rate 10 --out ";
  ASSERT_EQ(run(brief + path("flight")), 0);
  EXPECT_EQ(run(brief + path("flight")), 1);
  EXPECT_EQ(run(brief + path("flight") + " --force"), 0);
  fs::create_directories(path("precious/photos"));
  EXPECT_EQ(run(brief + path("precious") + " --force"), 1);
  EXPECT_TRUE(fs::exists(path("precious/photos")));
}

}  // namespace
}  // namespace ardrone_vslam
