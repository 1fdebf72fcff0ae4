// SPDX-License-Identifier: BSD-3-Clause
// The scripts as programs: --version, what wrong usage is told, and what counts as a whole flight.

#include <sys/wait.h>

#include <cstdlib>
#include <iterator>

#include "support/sequence_folders.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class ScriptUsage : public testing::Test {
 protected:
  /// Exit code; what is printed goes to output().
  int run(const std::string& command) const {
    const int status = std::system((command + " > " + folder_.file("output") + " 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int script(const std::string& command) const {
    return run(test::packageFile("scripts/") + command);
  }
  std::string output() const {
    std::ifstream file(folder_.file("output"));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void expectOutput(const std::vector<std::string>& parts) const {
    for (const auto& part : parts) {
      EXPECT_NE(output().find(part), std::string::npos) << part << " is not in: " << output();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(ScriptUsage, EachSaysItsVersionAndRefusesUnknownOptions) {
  for (const std::string name :
       {"test", "demo", "benchmark", "install_dependencies", "evaluate", "evaluate_all",
        "reproduce", "record_run", "measure_latency", "build_docs", "try_containerfile",
        "cross_build", "cross_sysroot", "drone_cost", "check_style", "try_releases"}) {
    EXPECT_EQ(script(name + " --version"), 0) << name << output();
    expectOutput({name + " (ardrone_vslam) 0."});
    EXPECT_EQ(script(name + " --no-such-option"), 2) << name;
    expectOutput({name, "usage"});
  }
}

TEST_F(ScriptUsage, TestHandsOnlyWhatFollowsTheDashesToCtest) {
  EXPECT_EQ(script("test -R unit"), 2);
  expectOutput({"test: unknown option '-R'", "after --"});
}

TEST_F(ScriptUsage, DemoNamesTheValueThatIsMissing) {
  for (const std::string option : {"--out", "--seconds", "--seed", "--rate"}) {
    EXPECT_EQ(script("demo " + option), 2) << option;
    expectOutput({"demo: " + option + " needs a value"});
  }
  EXPECT_EQ(script("demo --seconds ten"), 2);
  expectOutput({"demo: --seconds 'ten'", "number"});
  EXPECT_EQ(script("demo --headless-screenshot " + folder_.file("picture")), 2);
  expectOutput({"demo: --headless-screenshot", ".png or .gif"});
}

TEST_F(ScriptUsage, PlayBagNamesTheBagThatIsNotThere) {
  const std::string bag = folder_.file("none.bag");
  EXPECT_EQ(script("play_bag --clock --bags=" + bag + " __name:=player"), 1);
  expectOutput({"play_bag: " + bag + ": there is no such file", "full path"});
}

#if ARDRONE_VSLAM_MAKE_WORLD_WRITES_BAGS
TEST_F(ScriptUsage, PlayBagNamesTheBagThatIsDamaged) {
  folder_.write("text.bag", "no bag at all\n");
  EXPECT_EQ(script("play_bag --clock --bags=" + folder_.file("text.bag")), 1);
  expectOutput(
      {"play_bag: " + folder_.file("text.bag") + ": is no readable bag", "rosbag reindex"});
}
#endif

TEST_F(ScriptUsage, RecordRunCountsImagesWithoutPoseAndKnowsItsNees) {
  folder_.write(
      "check.py",
      "import importlib.machinery, importlib.util, sys\n"
      "sys.dont_write_bytecode = True\n"
      "loader = importlib.machinery.SourceFileLoader('record_run', sys.argv[1])\n"
      "module = importlib.util.module_from_spec(importlib.util.spec_from_loader("
      "'record_run', loader))\n"
      "loader.exec_module(module)\n"
      "topics = [{1, 2, 3, 4, 5}, {11, 12}]\n"
      "assert module.unanswered(topics, [2, 3, 4, 5], False) == (topics[0], [])\n"
      "assert module.unanswered(topics, [2, 3], False) == (topics[0], [4, 5])\n"
      "assert module.unanswered(topics, [1, 3, 5], False) == (topics[0], [2, 4])\n"
      "assert module.unanswered(topics, [1, 3], True) == (topics[0], [2])\n"
      "import numpy as np\n"
      "error_m, covariance_m2 = np.array([1, 0, 4]), np.array([[2, 1, 0], [1, 2, 0], [0, 0, 8]])\n"
      "assert abs(module.nees(error_m, covariance_m2) - (2 / 3 + 2)) < 1e-12\n"
      "assert np.isnan(module.nees(error_m, np.zeros((3, 3))))\n"
      "assert np.isnan(module.nees(error_m, np.full((3, 3), np.nan)))\n"
      "assert module.known(np.nan) == '' and module.known(0.5) == 0.5\n");
  EXPECT_EQ(run("/usr/bin/python3 " + folder_.file("check.py") + " " +
                test::packageFile("scripts/record_run")),
            0)
      << output();
}

}  // namespace
}  // namespace ardrone_vslam
