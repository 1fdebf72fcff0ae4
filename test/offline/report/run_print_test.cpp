// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_print.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "summary/seeds_summary.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json runOf(int seed, double odometry_m, double fused_m) {
  Json run;
  run["sequence"] = "flight";
  run["frames"] = 4;
  run["profile"] = "drone";
  run["estimator"] = "thesis";
  run["seed"] = seed;
  run["odometry_ate_rmse_m"] = odometry_m;
  run["fused_ate_rmse_m"] = fused_m;
  run["ratio"] = fused_m / odometry_m;
  run["ratio_scale_removed"] = nullptr;
  return run;
}

TEST(RunPrint, SeedsAreATableWithMedianAndWorst) {
  std::ostringstream out;
  printSeeds(summaryOfSeeds({runOf(1, 2, 0.5), runOf(2, 1, 0.9), runOf(3, 10, 4)}), out);
  EXPECT_EQ(out.str(),
            "  seed  odometry RMSE [m]  fused RMSE [m]  ratio  ratio_scale_removed\n"
            "     1             2.0000          0.5000  0.250                    -\n"
            "     2             1.0000          0.9000  0.900                    -\n"
            "     3            10.0000          4.0000  0.400                    -\n"
            "median             2.0000          0.9000  0.400                    -\n"
            " worst            10.0000          4.0000  0.900                    -\n");
}

TEST(RunPrint, SeedsWithoutTruthAreDashes) {
  Json run = runOf(7, 1, 1);
  for (const char* key : {"odometry_ate_rmse_m", "fused_ate_rmse_m", "ratio"}) run[key] = nullptr;
  std::ostringstream out;
  printSeeds(summaryOfSeeds({run}), out);
  const std::string dashes = "                  -               -      -                    -\n";
  EXPECT_NE(out.str().find("     7" + dashes + "median" + dashes + " worst" + dashes),
            std::string::npos)
      << out.str();
}

}  // namespace
}  // namespace ardrone_vslam
