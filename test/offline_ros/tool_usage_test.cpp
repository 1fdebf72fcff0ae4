// SPDX-License-Identifier: BSD-3-Clause
// replay and make_bag as programs: what does not fit is refused by name, with the exit code that
// tells wrong usage (2) from faults of the input (1).

#include <sys/wait.h>

#include <cstdlib>

#include "bag_damage.hpp"
#include "support/read_file.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class ToolUsage : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string output() const { return test::readFile(path("output")); }

  /// Exit code, 128 and more for a signal; what it prints goes to the file `output`.
  int run(const std::string& command) const {
    const int status = std::system((command + " > " + path("output") + " 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int replay(const std::string& arguments) const {
    return run(test::program("replay") + " " + arguments + " --out " + path("run"));
  }
  int makeBag(const std::string& arguments) const {
    return run(test::program("make_bag") + " " + arguments);
  }
  void expectOutput(const std::vector<std::string>& parts) const {
    for (const auto& part : parts) {
      EXPECT_NE(output().find(part), std::string::npos) << part << " is not in: " << output();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(ToolUsage, ReplayRefusesABagsOptionsForAFolder) {
  makeKittiFolder(folder_, 3);
  for (const std::string option : {"--image-topic", "--camera-info-topic", "--odometry-topic",
                                   "--truth-topic", "--camera-frame", "--base-frame", "--camera"}) {
    EXPECT_EQ(replay(folder_.path() + " " + option + " x"), 2) << option;
    expectOutput({"replay: ", folder_.path(), "is a folder", option + " is for bags only"});
  }
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

TEST_F(ToolUsage, SeedsAreWholeNumbersAndNeedAProfile) {
  makeKittiFolder(folder_, 3);
  for (const std::string value : {" -1", "=-1", " 0.5", " x"}) {
    EXPECT_EQ(replay(folder_.path() + " --seed" + value), 2) << value;
    expectOutput({"--seed", "whole number from 0"});
    EXPECT_EQ(makeBag("kitti " + folder_.path() + " --out " + path("a.bag") + " --seed" + value),
              2);
    expectOutput({"--seed", "whole number from 0"});
  }
  for (const std::string value : {"-1:2", "1:-1", "3:2", "x"}) {
    EXPECT_EQ(replay(folder_.path() + " --seeds=" + value), 2) << value;
    expectOutput({"replay: --seeds: '" + value + "'", "1:5"});
  }
  const TestBag bag{BagRecipe()};
  EXPECT_EQ(replay(bag.path() + " --seed 3"), 2);
  expectOutput({"--seed needs --odometry-profile"});
  EXPECT_EQ(replay(bag.path() + " --seeds 1:2"), 2);
  expectOutput({"--seeds needs --odometry-profile"});
}

TEST_F(ToolUsage, AFramesFaultIsWrongUsage) {
  makeKittiFolder(folder_, 3);
  EXPECT_EQ(replay(folder_.path() + " --frames 0:x"), 2);
  expectOutput({"replay: ", "0:x"});
  EXPECT_EQ(makeBag("kitti " + folder_.path() + " --out " + path("a.bag") + " --frames 0:x"), 2);
  expectOutput({"make_bag: ", "0:x"});
}

TEST_F(ToolUsage, ABagsNameEndsInBag) {
  makeKittiFolder(folder_, 3);
  for (const std::string name : {"out", "out.bg", "out/"}) {
    EXPECT_EQ(makeBag("kitti " + folder_.path() + " --out " + path(name)), 2) << name;
    expectOutput({"make_bag: --out " + path(name), "ends in .bag"});
  }
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  EXPECT_EQ(makeBag("kitti " + folder_.path() + " --out " + path("out.bag")), 0) << output();
  EXPECT_TRUE(std::filesystem::exists(path("out.bag")));
}

TEST_F(ToolUsage, AVideoStreamHasTruePosesOnlyAtRest) {
  const std::string command = "pave stream.pave --out " + path("a.bag");
  EXPECT_EQ(makeBag(command + " --odometry-profile drone"), 2);
  expectOutput({"make_bag: stream.pave", "--odometry-profile drone", "true poses", "--at-rest"});
  // With it the fault is that there is no such file.
  EXPECT_EQ(makeBag(command + " --odometry-profile drone --at-rest"), 1);
  expectOutput({"stream.pave", "check the path"});
}

TEST_F(ToolUsage, FaultsOfTheInputAreNoWrongUsage) {
  folder_.write("none.bag", "");
  EXPECT_EQ(replay(path("none.bag")), 1);
  expectOutput({"replay: ", "none.bag", "is empty"});
  EXPECT_EQ(replay(path("missing.bag")), 1);
  expectOutput({"replay: ", "missing.bag", "no such file"});
  EXPECT_EQ(makeBag("tum " + path("missing") + " --out " + path("a.bag")), 1);
  expectOutput({"make_bag: ", "missing"});
  EXPECT_EQ(run(test::program("replay")), 2);
  EXPECT_EQ(run(test::program("replay") + " --help"), 0);
  EXPECT_EQ(run(test::program("make_bag") + " --version"), 0);
}

TEST_F(ToolUsage, WhatIsNamedOnTheCommandLineWronglyIsWrongUsage) {
  makeKittiFolder(folder_, 3);
  EXPECT_EQ(replay(folder_.path() + " --set max_clones"), 2);
  expectOutput({"replay: ", "'max_clones'", "key=value"});
  EXPECT_EQ(replay(folder_.path() + " --set no_such_key=1"), 2);
  expectOutput({"no_such_key"});
  EXPECT_EQ(replay(folder_.path() + " --estimator foo"), 2);
  expectOutput({"--estimator", "thesis"});
  EXPECT_EQ(replay(folder_.path() + " --estimator constraint"), 2);
  expectOutput({"replay: constraint is called msckf now"});
  EXPECT_EQ(replay(folder_.path() + " --observer-profile drone"), 2);
  expectOutput({"replay: --observer-profile is called --odometry-profile now"});
  EXPECT_EQ(replay(folder_.path() + " --odometry-profile foo"), 2);
  expectOutput({"replay: --odometry-profile", "'foo'", "drone"});
  EXPECT_EQ(
      makeBag("kitti " + folder_.path() + " --out " + path("a.bag") + " --odometry-profile foo"),
      2);
  expectOutput({"make_bag: --odometry-profile", "'foo'", "drone"});
  folder_.write("wrong.yaml", "tracker: {no_such_key: 1}\n");
  EXPECT_EQ(replay(folder_.path() + " --config " + path("wrong.yaml")), 1);
  expectOutput({"no_such_key"});
}

TEST_F(ToolUsage, RecordedOdometryDoesNotRunBackwards) {
  const TestBag bag{BagRecipe()};
  EXPECT_EQ(replay(bag.path() + " --ping-pong"), 2);
  expectOutput({"replay: ", bag.path(), "cannot run backwards", "--odometry-profile"});
}

TEST_F(ToolUsage, TheConfigurationsBaseFrameHolds) {
  const TestBag bag{BagRecipe()};
  folder_.write("body.yaml", "mapper: {base_frame: body}\n");
  const std::string from_body = "no transform from the base frame 'body' to the camera frame 'cam'";
  const std::string config = " --config " + path("body.yaml");
  EXPECT_EQ(replay(bag.path() + config), 1);
  expectOutput({from_body});
  EXPECT_EQ(replay(bag.path() + config + " --base-frame nothing"), 1);
  expectOutput({"no transform from the base frame 'nothing'"});
  // The tiny images show no corner: nothing is wrong with the frames.
  EXPECT_EQ(replay(bag.path() + config + " --set base_frame=mount"), 1);
  expectOutput({"no image shows a corner"});
}

TEST_F(ToolUsage, ARunLeavesNothingOfTheOneBefore) {
  const std::string flight =
      test::packageFile("bags/laps_20s.bag") + " --frames 0:20 --odometry-profile drone";
  const auto has = [this](const std::string& name) {
    return std::filesystem::exists(path("run/" + name));
  };
  EXPECT_EQ(replay(flight + " --seeds 1:3"), 0) << output();
  expectOutput({"  seed  odometry RMSE [m]", "\nmedian", "\n worst"});
  EXPECT_TRUE(has("seed_3/fused.tum") && has("summary.json") && !has("fused.tum"));
  folder_.write("run/notes.txt", "");
  EXPECT_EQ(replay(flight), 0) << output();
  EXPECT_TRUE(has("fused.tum") && has("notes.txt") && !has("seed_3"));
  EXPECT_EQ(replay(flight + " --seeds 2:2"), 0) << output();
  EXPECT_TRUE(has("seed_2/fused.tum") && has("notes.txt") && !has("fused.tum"));
}

TEST_F(ToolUsage, ADeviceIsNoBag) {
  EXPECT_EQ(replay("/dev/null"), 1);
  expectOutput({"replay: /dev/null", "device"});
}

TEST_F(ToolUsage, HelpNamesChoicesPlainly) {
  for (const std::string kind : {"kitti", "tum", "pave"}) {
    EXPECT_EQ(makeBag(kind + " --help"), 0);
    expectOutput({"raw,png,jpeg", "none,lz4,bz2", "--ping-pong"});
    EXPECT_EQ(output().find("ENUM"), std::string::npos);
    EXPECT_EQ(output().find("->"), std::string::npos);
  }
}

TEST_F(ToolUsage, ATumFolderIsFlownWithTheDronesProfile) {
  makeTumFolder(folder_, 5);
  EXPECT_EQ(makeBag("tum " + folder_.path() + " --out " + path("a.bag")), 0) << output();
  expectOutput({"odometry profile drone"});
  folder_.remove("poses_tum.txt");
  EXPECT_EQ(replay(folder_.path()), 1);
  expectOutput({"the profile 'drone'"});
}

TEST_F(ToolUsage, ReplayOfOdometryThatRunsAwayFails) {
  BagRecipe recipe;
  for (std::size_t i = 1; i < recipe.odometry.size(); ++i)
    recipe.odometry[i].pose.pose.position.x = 1e300;
  const TestBag bag(recipe);
  EXPECT_EQ(replay(bag.path()), 1);
  expectOutput({"replay: ", "/odom", "4 messages dropped", "1e7 m"});
}

TEST_F(ToolUsage, ReplayOfADamagedBagNamesItAndDoesNotCrash) {
  std::string bytes = bytesOfRecipe(BagRecipe(), rosbag::compression::Uncompressed);
  // The first index entry's offset leads far out of its chunk.
  const std::size_t index = bytes.find(std::string("op=\4", 4));
  ASSERT_NE(index, std::string::npos);
  const std::size_t data = bytes.find(std::string("ver=\1\0\0\0", 8), index) + 8 + 4;
  bytes.replace(data + 8, 4, "\xff\xff\xff\x7f");
  folder_.write("damaged.bag", bytes);
  EXPECT_EQ(replay(path("damaged.bag")), 1);
  expectOutput({"replay: ", "damaged.bag", "is no readable bag", "rosbag reindex"});
}

TEST_F(ToolUsage, ABagThatDoesNotFitOnTheDiskLeavesNothing) {
  makeTumFolder(folder_, 60);
  const auto onFullDisk = [this](const std::string& command) {  // a write fails as on a full disk
    return run("bash -c \"trap '' XFSZ; ulimit -f 20; " + command + "\"");
  };
  for (const std::string format : {"", " --compression lz4", " --compression bz2"}) {
    EXPECT_EQ(onFullDisk(test::program("make_bag") + " tum " + folder_.path() + " --out " +
                         path("full.bag") + format),
              1)
        << format << output();
    expectOutput({"make_bag: ", "full.bag: cannot be written", "free space"});
  }
  EXPECT_EQ(onFullDisk(test::program("make_world") + " laps --seconds 1 --out " + path("full.bag")),
            1);
  expectOutput({"make_world: ", "full.bag: cannot be written"});
  EXPECT_FALSE(std::filesystem::exists(path("full.bag")));
  EXPECT_FALSE(std::filesystem::exists(path("full.bag.part")));
}

TEST_F(ToolUsage, OutputThatCannotBeWrittenIsAFault) {
  for (const std::string argument : {"--help", "--version", "--list-parameters"}) {
    const int status = std::system(
        (test::program("replay") + " " + argument + " > /dev/full 2> " + path("output")).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << argument;
    expectOutput({"replay: the output cannot be written"});
  }
}

TEST_F(ToolUsage, ReplayOfWhatIsLeftOfABagFails) {
  BagRecipe recipe;
  recipe.image_stamps_s = {1.0, 1.1, 1001, 1.2, 1.3};
  EXPECT_EQ(replay(TestBag(recipe).path()), 1);
  expectOutput({"/cam/image: 1 images have no stamp or one out of order"});
}

TEST_F(ToolUsage, TheDriversOptionsGoWithADriver) {
  const auto makeWorld = [this](const std::string& arguments) {
    return run(test::program("make_world") + " laps --seconds 0.1 --out " + path("d.bag") + " " +
               arguments);
  };
  EXPECT_EQ(makeWorld("--fault bursts"), 2);
  expectOutput({"make_world: ", "--driver ardrone"});
  EXPECT_EQ(makeWorld("--driver ardrone --fault bursts --fault slow"), 2);
  expectOutput({"no fault 'slow'", "all, released, mirrored_yaw"});
  EXPECT_EQ(makeWorld("--driver ardrone --range-noise 0.1"), 2);
  expectOutput({"--range-noise", "altd"});
  EXPECT_EQ(makeWorld("--driver ardrone --tf-prefix a/b"), 2);
  expectOutput({"--tf-prefix: 'a/b'"});
  EXPECT_EQ(run(test::program("make_world") + " laps --driver ardrone --out " + path("folder")), 2);
  expectOutput({"--driver is for bags only"});
  EXPECT_FALSE(std::filesystem::exists(path("d.bag")));
  EXPECT_EQ(makeWorld("--driver ardrone --fault all --compressed jpeg"), 0);
  expectOutput({"d.bag: 2 images", "odometry profile drone"});
}

}  // namespace
}  // namespace ardrone_vslam
