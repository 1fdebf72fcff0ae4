// SPDX-License-Identifier: BSD-3-Clause
// Equal input, equal bytes: poses, map and all that frames.csv says but the times, whatever the
// number of threads and the kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "ardrone_vslam/instruction_set.hpp"
#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

/// Without the columns ms_detect to ms_total, which are the last.
std::string withoutTimes(const std::string& csv) {
  const std::string header = csv.substr(0, csv.find('\n'));
  const auto times = std::count(header.begin() + static_cast<std::ptrdiff_t>(header.find(",ms_")),
                                header.end(), ',');
  std::string kept;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    for (auto i = times; i > 0; --i) line.erase(line.rfind(','));
    kept += line + '\n';
  }
  return kept;
}

class ReplayDeterminism : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    // Long enough for landmarks of the lap before.
    ASSERT_EQ(std::system((test::program("make_world") + " laps --seconds 20 --rate 5 --out " +
                           folder_->file("flight") + " 2> " + folder_->file("told"))
                              .c_str()),
              0)
        << test::readFile(folder_->file("told"));
  }
  static void TearDownTestSuite() { delete folder_; }

  struct Run {
    std::string poses;
    std::string frames;
    std::string map;
    std::string kernels;
  };
  Run replay(const std::string& options, const std::string& kernels = "") const {
    const std::string out = folder_->file("run");
    const std::string command = "ARDRONE_VSLAM_KERNELS=" + kernels + " " + test::program("replay") +
                                " " + folder_->file("flight") + " --out " + out + " --save-map " +
                                out + "/map.vmap " + options + " > " + folder_->file("told") +
                                " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << test::readFile(folder_->file("told"));
    const auto summary = nlohmann::json::parse(test::readFile(out + "/summary.json"));
    return {test::readFile(out + "/fused.tum"), withoutTimes(test::readFile(out + "/frames.csv")),
            test::readFile(out + "/map.vmap"), summary["instruction_set"]};
  }
  void expectEqual(const Run& one, const Run& other) const {
    EXPECT_FALSE(one.poses.empty());
    EXPECT_FALSE(one.map.empty());
    EXPECT_TRUE(one.poses == other.poses) << "fused.tum";
    EXPECT_TRUE(one.frames == other.frames) << "frames.csv";
    EXPECT_TRUE(one.map == other.map) << "the map";
  }

  static TemporaryFolder* folder_;
};
TemporaryFolder* ReplayDeterminism::folder_ = nullptr;

TEST_F(ReplayDeterminism, OverRunsAndThreads) {
  const Run first = replay("");
  EXPECT_NE(first.frames.find(",localised,"), std::string::npos) << "the map was not used";
  expectEqual(first, replay(""));
  for (const std::string threads : {"1", "2", "4"}) {
    SCOPED_TRACE(threads);
    expectEqual(first, replay("--threads " + threads));
  }
  const Run other = replay("--seed 2");
  EXPECT_TRUE(first.poses != other.poses && first.map != other.map) << "nothing is compared";
}

TEST_F(ReplayDeterminism, OverKernels) {
  const Run scalar = replay("", nameOf(InstructionSet::kScalar));
  for (const InstructionSet set : supportedInstructionSets()) {
    SCOPED_TRACE(nameOf(set));
    const Run run = replay("", nameOf(set));
    EXPECT_EQ(run.kernels, nameOf(set));
    expectEqual(scalar, run);
  }
}

}  // namespace
}  // namespace ardrone_vslam
