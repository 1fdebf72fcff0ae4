// SPDX-License-Identifier: BSD-3-Clause
#include "summary/run_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json flight() {
  return {{"frames", 100},
          {"duration_s", 9.94},
          {"distance_m", 12.3},
          {"states", {{"building_map", 5}, {"tracking", 45}, {"localised", 50}}},
          {"estimator", "msckf"},
          {"frames_distrusted", 0},
          {"odometry_ate_rmse_m", 1.9104},
          {"fused_ate_rmse_m", 0.0962},
          {"fused_error_max_m", 0.333},
          {"ratio", 0.0504},
          {"ratio_scale_removed", 0.05},
          {"nees_mean", 1.5},
          {"outside_3_sigma", 0.02},
          {"landmarks", 9642},
          {"heights_used", 0},
          {"ms_per_frame_median", 2.257},
          {"ms_per_frame_p95", 4.089}};
}

Json withRatio(double ratio) {
  Json run = flight();
  run["ratio"] = run["ratio_scale_removed"] = ratio;
  run["fused_ate_rmse_m"] = 1.9104 * ratio;
  return run;
}

TEST(RunWords, AFlightIsSixLinesAndASentence) {
  EXPECT_EQ(inLines(flight()),
            "images      100 in 9.9 s, 12.3 m travelled\n"
            "odometry    off by 1.91 m (RMSE)\n"
            "fused       off by 0.096 m (RMSE), at most by 0.33 m; 0.050 of the odometry's\n"
            "covariance  honest: squared errors are 0.50 times the expected ones, 2.0 % of the "
            "images beyond 3 sigma\n"
            "states      building_map 5, tracking 45, localised 50 images; 9642 landmarks\n"
            "cost        2.26 ms an image, below 4.09 ms for 95 % of them\n");
  EXPECT_EQ(verdictOf(flight()),
            "It helped: the odometry is off by 1.91 m, the fused pose by 0.096 m (RMSE).");
}

TEST(RunWords, WithoutTruthNothingIsClaimed) {
  Json run = flight();
  for (const char* key : {"odometry_ate_rmse_m", "fused_ate_rmse_m", "fused_error_max_m", "ratio",
                          "nees_mean", "outside_3_sigma"})
    run[key] = nullptr;
  const std::string lines = inLines(run);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
  EXPECT_EQ(lines.find("off by"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("honest"), std::string::npos) << lines;
  EXPECT_EQ(verdictOf(run).find("Without ground truth"), 0U);
}

TEST(RunWords, TheTruthAsOdometryLeavesNothingToGain) {
  Json run = flight();
  run["ratio"] = nullptr;
  EXPECT_NE(verdictOf(run).find("nothing to gain"), std::string::npos);
}

TEST(RunWords, NoGainAndHarmAreToldApart) {
  EXPECT_EQ(verdictOf(withRatio(0.9)).find("It helped: "), 0U);
  EXPECT_EQ(verdictOf(withRatio(1.0)).find("It did not help: "), 0U);
  EXPECT_EQ(verdictOf(withRatio(1.2)).find("It did harm: "), 0U);
}

TEST(RunWords, TheCovarianceIsJudged) {
  Json run = flight();
  run["nees_mean"] = 4.6;
  EXPECT_NE(inLines(run).find("covariance  too small: "), std::string::npos);
  run["nees_mean"] = 0.8;
  EXPECT_NE(inLines(run).find("covariance  larger than the errors: "), std::string::npos);
}

struct Cause {
  const char* key;
  Json value;
  const char* told;
};

TEST(RunWords, WhyNothingWasGained) {
  const std::vector<Cause> causes{
      {"estimator", "odometry", "estimator: odometry"},
      {"frames_distrusted", 60, "not believed in 60"},
      {"landmarks", 0, "must move past what it sees"},
      {"distance_m", 400, "errs by 0.48 % of the distance"},
      {"ratio_scale_removed", 0.5, "use_range"},
      {"states", {{"tracking", 90}, {"localised", 10}}, "come back to where"},
      {"states", {{"localised", 100}}, "doctor may tell"},
  };
  for (const Cause& cause : causes) {
    Json run = withRatio(1.0);
    run[cause.key] = cause.value;
    EXPECT_NE(verdictOf(run).find(cause.told), std::string::npos) << verdictOf(run);
  }
}

}  // namespace
}  // namespace ardrone_vslam
