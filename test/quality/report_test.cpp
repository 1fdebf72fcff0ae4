// SPDX-License-Identifier: BSD-3-Clause
// benchmark/report.py as a program, on made-up measurements.

#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/sequence_folders.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class Report : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import numpy, matplotlib' 2> /dev/null") != 0) {
      GTEST_SKIP() << "needs the packages python3-numpy and python3-matplotlib";
    }
    const std::string command =
        test::packageFile("benchmark/report.py") + " " + test::dataFile("benchmark/measured.json") +
        " --revision abc --page " + folder_.file("page.md") + " --json " +
        folder_.file("rows.json") + " > " + folder_.file("output") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << text("output");
  }
  std::string text(const std::string& name) const {
    std::ifstream file(folder_.file(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder folder_;
};

TEST_F(Report, PageAndNumbersHaveTheRowsWithBothSides) {
  const std::string page = text("page.md");
  for (const char* part :
       {"OpenCV 4.6.0; libbenchmark 1.7.1; frames: generated; source: abc.",
        // Medians, 200 of 100, 900 and 200 us, and no aggregate.
        "| 200 us | cv::FAST | 500 us | **2.5** | 1000, 1000 | 200 ns, 500 ns |  |\n",
        "| 2 ms | FLANN | 40 ms | **20.0** | 1000, 1000 | 2 us, 40 us | 0.970, 0.950 |\n",
        "| passes4_kitti | 4 of 16 passes | 400 us | scalar | 800 us | **2.0** |",
        "| fast9_kitti | 2.2 | 2.5 |\n", "| freak_kitti | 5 | 2.5, **missed** |\n",
        "](plots/passes.png)", "](plots/map_size.png)"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << " is not in: " << page;
  }
  EXPECT_EQ(page.find("| alone"), std::string::npos);
  for (const char* plot : {"plots/passes.png", "plots/map_size.png"})
    EXPECT_FALSE(cv::imread(folder_.file(plot)).empty()) << plot;

  const auto rows = nlohmann::json::parse(text("rows.json"));
  EXPECT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows["fast9_kitti"]["peer"], "cv::FAST");
  EXPECT_EQ(rows["fast9_kitti"]["ours_ns"], 200000);
  EXPECT_EQ(rows["index_100k"]["ratio"], 20);
  EXPECT_EQ(rows["index_100k"]["ours_share"], 0.97);
  EXPECT_NE(text("output").find("fast9_kitti"), std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam
