// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "ardrone_vslam/saved_map.hpp"
#include "support/read_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

class ReplayRefine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(std::system((test::program("make_world") + " laps --seconds 20 --rate 10 --out " +
                           folder_->file("flight") + " 2> " + folder_->file("told"))
                              .c_str()),
              0)
        << test::readFile(folder_->file("told"));
  }
  static void TearDownTestSuite() { delete folder_; }

  /// @return exit code
  int replay(const std::string& options) const {
    return std::system((test::program("replay") + " " + folder_->file("flight") + " --out " +
                        folder_->file("run") + " --odometry-profile drone " + options + " > " +
                        folder_->file("told") + " 2>&1")
                           .c_str());
  }
  std::string file(const std::string& name) const { return folder_->file(name); }
  std::string told() const { return test::readFile(file("told")); }

 private:
  static TemporaryFolder* folder_;
};

TemporaryFolder* ReplayRefine::folder_ = nullptr;

TEST_F(ReplayRefine, TheWholeFlightKnowsMoreThanItsParts) {
  const std::string map = file("map.vmap");
  ASSERT_EQ(replay("--seed 1 --refine --save-map " + map), 0) << told();
  const auto summary = nlohmann::json::parse(test::readFile(file("run/summary.json")));
  // 0.45 measured; 0.45 to 0.99 for the seeds 0 to 9
  EXPECT_LT(summary["refined_ate_rmse_m"], 0.6 * summary["fused_ate_rmse_m"].get<double>());
  EXPECT_NE(told().find("\nrefined     off by "), std::string::npos) << told();
  EXPECT_GT(readMap(map).landmarks.size(), 100U);
  const std::string refined = test::readFile(file("run/refined.tum"));
  ASSERT_EQ(replay("--seed 1 --refine --threads 1"), 0) << told();
  EXPECT_EQ(test::readFile(file("run/refined.tum")), refined);
  ASSERT_EQ(replay("--seed 1"), 0) << told();
  EXPECT_EQ(test::readFile(file("run/refined.tum")), "");  // an earlier run's files go
}

TEST_F(ReplayRefine, ACameraThatIsTurnedIsToldWithItsDeviation) {
  const std::string map = file("turned.vmap");
  ASSERT_EQ(replay("--seed 1 --refine --setup-fault pitch=1 --set mapper/extrinsics_sigma_deg=1 "
                   "--save-map " +
                   map),
            0)
      << told();
  const auto summary = nlohmann::json::parse(test::readFile(file("run/summary.json")));
  const Eigen::Vector3d off_deg(0, 1, 0);  // about base's y
  for (int i = 0; i < 3; ++i) {
    const double sigma_deg = summary["refined_extrinsics_sigma_deg"][i];
    EXPECT_NEAR(summary["refined_extrinsics_error_deg"][i], off_deg[i], 2 * sigma_deg) << i;
    EXPECT_LT(sigma_deg, 0.9) << "less than was known before";
    EXPECT_GT(sigma_deg, 0.1);
  }
  EXPECT_LT(summary["refined_ate_rmse_m"], 0.6 * summary["fused_ate_rmse_m"].get<double>());
}

TEST_F(ReplayRefine, WhatItCannotRefineItSays) {
  EXPECT_NE(replay("--refine --estimator thesis"), 0);
  EXPECT_NE(told().find("--refine: needs the keyframes of estimator: msckf"), std::string::npos);
}

}  // namespace
}  // namespace ardrone_vslam
