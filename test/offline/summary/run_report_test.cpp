// SPDX-License-Identifier: BSD-3-Clause
#include "summary/run_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/run_files.hpp"
#include "report/run_verdict.hpp"
#include "summary/seeds_summary.hpp"
#include "support/sequence_folders.hpp"
#include "support/test_paths.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

/// Four frames a second apart along x; the odometry drifts sideways by 0.2 m a frame, the fused
/// pose by 0.1 m.
RunResult someRun() {
  RunResult run;
  for (int i = 0; i < 4; ++i) {
    RunFrame frame;
    frame.result.stamp_ns = 1'000'000'000LL * i;
    frame.result.T_map_base.translation() << i, 0.1 * i, 0;
    frame.result.T_odom_base.translation() << i, 0.2 * i, 0;
    frame.result.covariance.topLeftCorner<3, 3>() = 0.01 * Eigen::Matrix3d::Identity();
    frame.result.landmark_candidates = 10 * i + 2;
    frame.result.landmark_matches = 10 * i;
    if (i > 0) frame.result.fix_nis = 0.75 * i;
    if (i > 0) frame.result.track_nis = 0.5 * i;
    frame.result.velocity_bias_sigma_m_s = 0.01 * (1 + i);
    frame.result.yaw_walk_factor = 2.0 * i;
    frame.result.features = 100;
    frame.result.tracks = 80;
    frame.result.tracks_aligned = 20 * i;
    if (i == 3) {
      frame.result.state = SlamState::kLocalised;
      frame.result.landmark_position_map = Eigen::Vector3d(3, 0.4, 0);
      frame.result.landmark_sigma_m = 0.07;
    }
    frame.result.left_out = i > 1 ? LeftOut("100") : LeftOut("101");
    frame.times_ms = {1, 2, 3, 0, 0, static_cast<double>(i)};
    run.frames.push_back(frame);
  }
  run.landmarks = {Landmark(), Landmark()};
  run.landmarks.change(0).id = 11;
  run.landmarks.change(1).position_map << 1, 2, 3;
  return run;
}

Trajectory straightTruth() {
  Trajectory truth;
  for (int i = 0; i < 4; ++i) {
    StampedPose pose;
    pose.stamp_ns = 1'000'000'000LL * i;
    pose.T_frame_body.translation() << i, 0, 0;
    truth.append(pose);
  }
  return truth;
}

Json summaryFor(const std::string& profile, const Trajectory& truth) {
  const RunResult run = someRun();
  return summaryOf(run, evaluate(run, truth), {"sequence", profile, 5, "thesis"});
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(RunReport, PosesAreOfTheImagesExposures) {
  RunResult run = someRun();
  run.image_time_offset_s = 0.25;
  for (RunFrame& frame : run.frames) frame.image_time_offset_ns = 250'000'000;
  const RunEvaluation e = evaluate(run, straightTruth());
  EXPECT_EQ(e.fused.poses()[1].stamp_ns, 1'250'000'000);
  EXPECT_EQ(e.truth.poses()[1].stamp_ns, 1'250'000'000);
  EXPECT_NEAR(e.fused_error_m[1], std::hypot(0.25, 0.1), 1e-9);
  EXPECT_EQ(e.frames_without_truth, 1);  // the last one's exposure is behind its end
  Json summary = summaryOf(run, e, {});
  EXPECT_EQ(summary["image_time_offset_s"], 0.25);
  EXPECT_TRUE(summary["image_time_offset_found_s"].is_null()) << "told";
  EXPECT_TRUE(summary["image_time_offset_estimate_s"].is_null());
  run.time_offset_found_ns = run.frames.front().result.stamp_ns + 1'500'000'000;
  run.time_offset = {TimeOffsetState::kKnown, 0.3, 0.002};
  summary = summaryOf(run, e, {});
  EXPECT_EQ(summary["image_time_offset_found_s"], 1.5);
  EXPECT_EQ(summary["image_time_offset_estimate_s"], 0.3);
  EXPECT_EQ(summary["image_time_offset_sigma_s"], 0.002);
}

TEST(RunReport, SummaryHasAllThatIsAskedFor) {
  const Json summary = summaryFor("drone", straightTruth());
  for (const char* key :
       {"frames", "profile", "seed", "estimator", "odometry_ate_rmse_m", "fused_ate_rmse_m",
        "fused_error_mean_m", "fused_error_max_m", "ratio", "ratio_scale_removed", "t_rel_percent",
        "odometry_t_rel_percent", "nees_mean", "landmark_matches_median", "landmarks",
        "ms_per_frame_median", "ms_per_frame_p95", "peak_rss_mb"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["frames"], 4);
  EXPECT_EQ(summary["profile"], "drone");
  EXPECT_EQ(summary["seed"], 5);
  EXPECT_EQ(summary["estimator"], "thesis");
  const double mean_square = (0.01 + 0.04 + 0.09) / 4;
  EXPECT_NEAR(summary["fused_ate_rmse_m"], std::sqrt(mean_square), 1e-12);
  EXPECT_NEAR(summary["odometry_ate_rmse_m"], 2 * std::sqrt(mean_square), 1e-12);
  EXPECT_NEAR(summary["ratio"], 0.5, 1e-12);
  EXPECT_NEAR(summary["ratio_scale_removed"], 0.5, 1e-12);
  EXPECT_NEAR(summary["fused_error_mean_m"], 0.15, 1e-12);
  EXPECT_NEAR(summary["fused_error_max_m"], 0.3, 1e-12);
  EXPECT_NEAR(summary["tracks_aligned_share"], 120.0 / 320, 1e-12);
  EXPECT_NEAR(summary["track_nis_mean"], 1, 1e-12) << "of the frames that have one";
  EXPECT_NEAR(summary["velocity_bias_learned_m_s"], 0.04, 1e-12) << "of the last frame";
  EXPECT_EQ(summary["yaw_walk_learned_over_configured"], 6);
  EXPECT_NEAR(summary["nees_mean"], 100 * mean_square, 1e-9);
  EXPECT_EQ(summary["landmark_matches_median"], 15);
  EXPECT_EQ(summary["landmarks"], 2);
  EXPECT_EQ(summary["ms_per_frame_median"], 7.5);
  EXPECT_EQ(summary["ms_per_frame_max"], 9);
  EXPECT_EQ(summary["left_out"], Json({{"place_search", 2}, {"landmarks", 0}, {"keyframe", 4}}));
  EXPECT_GT(summary["peak_rss_mb"], 0);
  EXPECT_TRUE(summary["t_rel_percent"].is_null()) << "the path is shorter than 100 m";
  EXPECT_NEAR(summary["camera_error_mean_m"], 0.4, 1e-12);
  EXPECT_EQ(summary["camera_frames"], 1);
}

TEST(RunReport, RatioIsNullWhereTheOdometryIsTheTruth) {
  const Json summary = summaryFor("truth", straightTruth());
  EXPECT_TRUE(summary["ratio"].is_null());
  EXPECT_TRUE(summary["ratio_scale_removed"].is_null());
  EXPECT_FALSE(summary["fused_ate_rmse_m"].is_null());
}

TEST(RunReport, WithoutTruthNoErrorIsClaimed) {
  const Json summary = summaryFor("recorded", {});
  for (const char* key : {"odometry_ate_rmse_m", "fused_ate_rmse_m", "ratio", "nees_mean",
                          "camera_error_mean_m", "t_rel_percent"}) {
    EXPECT_TRUE(summary[key].is_null()) << key;
  }
  EXPECT_EQ(summary["frames"], 4);
}

TEST(RunReport, ScaleErrorThatWasDrawnIsRemoved) {
  RunResult run = someRun();
  run.scale_error = 0.1;
  for (RunFrame& frame : run.frames) {
    frame.result.T_map_base.translation() << 1.1 * frame.result.T_map_base.translation().x(), 0, 0;
    frame.result.T_odom_base = frame.result.T_map_base;
    frame.result.T_odom_base.translation().y() = 0.2;
  }
  const Json summary = summaryOf(run, evaluate(run, straightTruth()), {"s", "wheel", 1, "thesis"});
  EXPECT_GT(summary["fused_ate_rmse_m"], 0.1);
  EXPECT_NEAR(summary["fused_ate_rmse_scale_removed_m"], 0, 1e-12);
  EXPECT_NEAR(summary["odometry_ate_rmse_scale_removed_m"], 0.2, 1e-12);
  EXPECT_NEAR(summary["ratio_scale_removed"], 0, 1e-12);
  run.is_in_loaded_map = true;
  const Json in_map = summaryOf(run, evaluate(run, straightTruth()), {"s", "wheel", 1, "thesis"});
  for (const char* key : {"fused_ate_rmse_scale_removed_m", "odometry_ate_rmse_scale_removed_m",
                          "ratio_scale_removed"})
    EXPECT_TRUE(in_map[key].is_null()) << key << ": the map has a scale of its own";
}

TEST(RunReport, ThePageNamesEveryKeyOfTheSummary) {
  std::ifstream file(test::packageFile("docs/summary_keys.md"));
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  ASSERT_FALSE(page.empty());
  const Json summary = summaryFor("drone", straightTruth());
  for (const auto& item : summary.items())
    EXPECT_NE(page.find('`' + item.key() + '`'), std::string::npos)
        << item.key() << " has no row in docs/summary_keys.md";
}

TEST(RunReport, AnEmptyRunIsReportedToo) {
  const RunResult run;
  const Json summary = summaryOf(run, evaluate(run, straightTruth()), {"s", "drone", 1, "thesis"});
  EXPECT_EQ(summary["frames"], 0);
  EXPECT_TRUE(summary["ratio"].is_null());
  EXPECT_TRUE(summary["frames_per_second"].is_null());
}

TEST(RunReport, WorstOfSeedsIsTheLargestWhereLargerIsWorse) {
  std::vector<Json> summaries;
  for (const double ratio : {0.5, 0.9, 0.6}) {
    Json summary = summaryFor("drone", straightTruth());
    summary["ratio"] = ratio;
    summary["seed"] = summaries.size() + 1;
    summaries.push_back(summary);
  }
  const Json all = summaryOfSeeds(summaries);
  EXPECT_EQ(all["median"]["ratio"], 0.6);
  EXPECT_EQ(all["worst"]["ratio"], 0.9);
  EXPECT_EQ(all["seeds"], (Json{1, 2, 3}));
  EXPECT_EQ(all["runs"].size(), 3U);
  for (const char* better : {"frames_per_second", "landmark_matches_median", "landmarks",
                             "heights_used", "tracks_aligned_share"})
    EXPECT_FALSE(all["worst"].contains(better)) << better;
  EXPECT_FALSE(all["median"].contains("t_rel_percent")) << "null in some";
}

TEST(RunReport, FilesOfARun) {
  const TemporaryFolder folder;
  const std::string out = folder.file("deep/run");
  const RunResult run = someRun();
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  writeRun(out, run, evaluation, summaryOf(run, evaluation, {"s", "drone", 1, "thesis"}));
  EXPECT_EQ(readTum(out + "/fused.tum").size(), 4U);
  EXPECT_EQ(readTum(out + "/odometry.tum").size(), 4U);
  EXPECT_EQ(readTum(out + "/truth.tum").size(), 4U);
  std::ifstream json(out + "/summary.json");
  EXPECT_EQ(Json::parse(json)["frames"], 4);

  std::ifstream csv(out + "/frames.csv");
  std::string line;
  std::getline(csv, line);
  const auto names = cellsOf(line);
  const auto column = [&names](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    return static_cast<std::size_t>(found - names.begin());
  };
  std::vector<std::vector<std::string>> rows;
  while (std::getline(csv, line)) {
    rows.push_back(cellsOf(line));
    ASSERT_EQ(rows.back().size(), names.size());
  }
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2][column("stamp_ns")], "2000000000");
  EXPECT_EQ(rows[3][column("state")], "localised");
  EXPECT_EQ(rows[1][column("features")], "100");
  EXPECT_EQ(rows[1][column("landmark_matches")], "10");
  EXPECT_EQ(rows[1][column("landmark_mismatches")], "2");
  EXPECT_EQ(rows[1][column("landmarks")], "0");
  EXPECT_EQ(rows[0][column("camera_x_m")], "") << "no landmarks, no position by them";
  EXPECT_EQ(rows[3][column("camera_y_m")], "0.4");
  EXPECT_EQ(rows[3][column("camera_error_m")], "0.4");
  EXPECT_EQ(rows[2][column("fused_error_m")], "0.2");
  EXPECT_EQ(rows[2][column("odometry_error_m")], "0.4");
  EXPECT_EQ(rows[2][column("ms_map")], "2");
  EXPECT_EQ(rows[2][column("ms_total")], "8");
  for (const char* name : kStageNames) column(std::string("ms_") + name);
  column("sigma_m");
  EXPECT_EQ(rows[2][column("fix_nis")], "1.5");
  EXPECT_EQ(rows[0][column("fix_nis")], "") << "not known";
  EXPECT_EQ(rows[2][column("track_nis")], "1");
  EXPECT_EQ(rows[2][column("tracks")], "80");
  EXPECT_EQ(rows[2][column("tracks_aligned")], "40");
  EXPECT_EQ(rows[0][column("track_nis")], "") << "no track was used";
  EXPECT_EQ(rows[2][column("velocity_bias_sigma_m_s")], "0.03");

  std::ifstream landmarks(out + "/landmarks.csv");
  std::getline(landmarks, line);
  EXPECT_EQ(cellsOf(line).front(), "id");
  std::getline(landmarks, line);
  EXPECT_EQ(cellsOf(line).front(), "11");
}

TEST(RunReport, FramesAndLandmarksThatAreNotFiniteAreCounted) {
  const TemporaryFolder folder;
  RunResult run = someRun();
  run.frames[1].result.T_map_base.translation().x() = 1e300;
  run.frames[2].result.T_odom_base.translation().y() = -1e300;
  run.landmarks.change(0).position_map.z() = std::numeric_limits<double>::quiet_NaN();
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  const Json summary = summaryOf(run, evaluation, {"s", "drone", 1, "thesis"});
  EXPECT_EQ(summary["frames_error_not_finite"], 2);
  EXPECT_EQ(summary["landmarks_not_finite"], 1);
  writeRun(folder.path(), run, evaluation, summary);
  std::ifstream landmarks(folder.file("landmarks.csv"));
  std::string text{std::istreambuf_iterator<char>(landmarks), {}};
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  ASSERT_EQ(verdict.faults.size(), 2U);
  EXPECT_NE(verdict.faults[0].find("flight: the position error of 2 of 4 images is not finite"),
            std::string::npos);
  EXPECT_NE(verdict.faults[1].find("1 of 2 landmarks"), std::string::npos);
}

TEST(RunReport, AGoodRunHasNeitherWarningNorFault) {
  const RunResult run = someRun();
  const RunVerdict verdict = judgeRun("flight", run, evaluate(run, straightTruth()), false);
  EXPECT_TRUE(verdict.faults.empty());
  EXPECT_TRUE(verdict.warnings.empty());
}

TEST(RunReport, PosesThatNeverMoveAreAFaultWhenTheImagesTravel) {
  RunResult run = someRun();
  Trajectory still;
  const Trajectory moving = straightTruth();
  for (const StampedPose& pose : moving.poses())
    still.append({pose.stamp_ns, Eigen::Isometry3d::Identity()});
  EXPECT_TRUE(judgeRun("flight", run, evaluate(run, still), false).faults.empty());
  run.images_travel = true;
  EXPECT_TRUE(judgeRun("flight", run, evaluate(run, straightTruth()), false).faults.empty());
  const RunVerdict truth = judgeRun("flight", run, evaluate(run, still), false);
  ASSERT_EQ(truth.faults.size(), 1U);
  EXPECT_NE(truth.faults[0].find("flight: the truth never moves"), std::string::npos);
  for (RunFrame& frame : run.frames) frame.result.T_odom_base.setIdentity();
  const RunVerdict odometry = judgeRun("flight", run, evaluate(run, {}), false);
  ASSERT_EQ(odometry.faults.size(), 1U);
  EXPECT_NE(odometry.faults[0].find("flight: the odometry never moves"), std::string::npos);
}

TEST(RunReport, OdometryThatIsTooFastForMetresIsAWarning) {
  RunResult run = someRun();
  run.absurd_speed_m_s = 850;
  const RunVerdict verdict = judgeRun("flight", run, evaluate(run, straightTruth()), false);
  EXPECT_TRUE(verdict.faults.empty());
  ASSERT_EQ(verdict.warnings.size(), 1U);
  for (const char* part : {"flight: ", "850 m/s", "metres are expected"})
    EXPECT_NE(verdict.warnings[0].find(part), std::string::npos) << part;
}

TEST(RunReport, ADroneThatWasCarriedIsCountedAndAWarning) {
  RunResult run = someRun();
  run.frames[2].result.revisit_m = 3.5;
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  EXPECT_EQ(summaryOf(run, evaluation, {"s", "drone", 1, "msckf"})["revisits"], 1);
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  ASSERT_EQ(verdict.warnings.size(), 1U);
  EXPECT_NE(verdict.warnings[0].find("3.5 m from where it was thought to be"), std::string::npos);
}

TEST(RunReport, OdometryThatStepsOrFreezesIsCountedAndAWarning) {
  RunResult run = someRun();
  run.frames[1].result.odometry_step_m = 0.7;
  run.frames[2].result.odometry_step_m = 2.5;
  run.odometry_froze = true;
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  const Json summary = summaryOf(run, evaluation, {"s", "drone", 1, "msckf"});
  EXPECT_EQ(summary["odometry_steps"], 2);
  EXPECT_EQ(summary["odometry_froze"], true);
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  EXPECT_TRUE(verdict.faults.empty());
  ASSERT_EQ(verdict.warnings.size(), 2U);
  EXPECT_NE(verdict.warnings[0].find("stood still"), std::string::npos);
  EXPECT_NE(verdict.warnings[1].find("2.5 m"), std::string::npos);
}

TEST(RunReport, ImagesAtWhichTheCameraIsDistrustedAreCountedAndAWarning) {
  RunResult run = someRun();
  run.frames[1].result.state = SlamState::kDistrusted;
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  EXPECT_EQ(summaryOf(run, evaluation, {"s", "drone", 1, "msckf"})["frames_distrusted"], 1);
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  ASSERT_EQ(verdict.warnings.size(), 1U);
  EXPECT_NE(verdict.warnings[0].find("contradict each other"), std::string::npos);
}

TEST(RunReport, TheOdometrysFaultsAreCountedAndWarnedOf) {
  RunResult run = someRun();
  run.odometry_faults[static_cast<std::size_t>(OdometryFault::kBurst)] = 12;
  run.odometry_faults[static_cast<std::size_t>(OdometryFault::kNoCovariance)] = 900;
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  const Json summary = summaryOf(run, evaluation, {"s", "drone", 1, "msckf"});
  EXPECT_EQ(summary["odometry_faults"]["burst"], 12);
  EXPECT_EQ(summary["odometry_faults"]["no_covariance"], 900);
  EXPECT_EQ(summary["odometry_faults"]["jump"], 0);
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  EXPECT_TRUE(verdict.faults.empty());
  ASSERT_EQ(verdict.warnings.size(), 1U) << "many sound drivers give no covariance";
  for (const char* part : {"flight: the odometry sends several", "(burst: 12)"})
    EXPECT_NE(verdict.warnings[0].find(part), std::string::npos) << part;
}

TEST(RunReport, ARunWithoutLandmarksSaysWhyThatMayBe) {
  RunResult run = someRun();
  run.landmarks.clear();
  const RunVerdict verdict = judgeRun("flight", run, evaluate(run, straightTruth()), false);
  EXPECT_TRUE(verdict.faults.empty());
  ASSERT_EQ(verdict.warnings.size(), 1U);
  for (const char* why : {"no landmark", "dark", "motion", "calibration"})
    EXPECT_NE(verdict.warnings[0].find(why), std::string::npos) << why;
}

TEST(RunReport, ARunWithoutOdometryForMoreThanOneImageInTwentyIsAFault) {
  RunResult run = someRun();
  while (run.frames.size() < 19) {
    run.frames.push_back(run.frames.back());
    run.frames.back().result.stamp_ns += 1'000'000'000;
  }
  run.frames_without_odometry = 1;
  const RunEvaluation evaluation = evaluate(run, straightTruth());
  const RunVerdict few = judgeRun("flight", run, evaluation, false);
  EXPECT_TRUE(few.faults.empty());
  ASSERT_FALSE(few.warnings.empty());
  EXPECT_NE(few.warnings[0].find("1 images have no odometry"), std::string::npos);
  run.frames_without_odometry = 2;
  const RunVerdict verdict = judgeRun("flight", run, evaluation, false);
  ASSERT_EQ(verdict.faults.size(), 1U);
  EXPECT_NE(verdict.faults[0].find("2 of 21 images have no usable odometry"), std::string::npos);
}

TEST(RunReport, FoldersThatCannotBeMadeAreNamed) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const RunResult run;
  try {
    writeRun(folder.file("file/run"), run, {}, Json::object());
    FAIL() << "must throw";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(folder.file("file/run")), std::string::npos);
  }
}

}  // namespace
}  // namespace ardrone_vslam
