// SPDX-License-Identifier: BSD-3-Clause
// When a run sends its user to doctor, and when it does not.
#include "report/run_verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ardrone_vslam {
namespace {

/// 100 images of 40 tracks each.
RunResult runWith(int used_of_40) {
  RunResult run;
  for (int i = 0; i < 100; ++i) {
    RunFrame frame;
    frame.result.features = 300;
    frame.result.feature_candidates = 40;
    frame.result.feature_matches = used_of_40;
    frame.result.T_odom_base.translation().x() = 0.1 * i;
    run.frames.push_back(frame);
  }
  run.landmarks = {Landmark()};
  return run;
}

bool sendsToDoctor(const RunResult& run, const std::string& name = "/tmp/a.bag") {
  const RunVerdict verdict = judgeRun(name, run, RunEvaluation(), false);
  EXPECT_TRUE(verdict.faults.empty());
  return std::any_of(verdict.warnings.begin(), verdict.warnings.end(), [&](const std::string& w) {
    return w.find("rosrun ardrone_vslam doctor " + name) != std::string::npos;
  });
}

TEST(RunVerdict, AGoodRunHasNoWarning) {
  EXPECT_TRUE(judgeRun("/tmp/a.bag", runWith(36), RunEvaluation(), false).warnings.empty());
  EXPECT_TRUE(judgeRun("/tmp/a.bag", runWith(24), RunEvaluation(), false).warnings.empty());
}

TEST(RunVerdict, TracksThatMoveOtherwiseSendToDoctor) {
  const RunResult run = runWith(4);
  EXPECT_TRUE(sendsToDoctor(run));
  EXPECT_EQ(judgeRun("/tmp/a.bag", run, RunEvaluation(), false).warnings.front(),
            "/tmp/a.bag: 90 % of the tracks do not move as odometry, calibration and the camera's "
            "mounting foretell");
  EXPECT_FALSE(sendsToDoctor(run, "/tmp/folder"));  // doctor reads bags
  RunResult seen = run;
  for (RunFrame& frame : seen.frames) frame.result.landmark_matches = 14;
  EXPECT_FALSE(sendsToDoctor(seen));  // a harsh odometry whose drift the map puts right
  RunResult few = run;
  few.frames.resize(20);
  EXPECT_FALSE(sendsToDoctor(few));
}

TEST(RunVerdict, SaysWhatWasLearnedOfTheOdometryAfterAMinute) {
  const auto warningsOf = [](double learned_m_s, double seconds, double yaw_factor = 1) {
    RunResult run = runWith(36);
    run.frames.back().result.yaw_walk_factor = yaw_factor;
    run.frames.front().result.velocity_bias_sigma_m_s = 0.03;
    run.frames.back().result.velocity_bias_sigma_m_s = learned_m_s;
    run.frames.back().result.stamp_ns = static_cast<std::int64_t>(seconds * 1e9);
    return judgeRun("/tmp/a.bag", run, RunEvaluation(), false).warnings;
  };
  ASSERT_EQ(warningsOf(0.13, 60).size(), 1U);
  EXPECT_EQ(warningsOf(0.13, 60).front(),
            "/tmp/a.bag: the odometry's velocity errs by 0.13 m/s where 0.03 was configured; with "
            "velocity_bias_m_s: 0.13 the covariance counts with it from the first image on");
  EXPECT_EQ(warningsOf(0.019, 60).size(), 1U) << "better than configured";
  EXPECT_TRUE(warningsOf(0.04, 60).empty()) << "no more than chance";
  EXPECT_TRUE(warningsOf(0.13, 50).empty()) << "too short";
  EXPECT_TRUE(warningsOf(0, 60).empty()) << "not estimated at the end";
  ASSERT_EQ(warningsOf(0.03, 60, 8).size(), 1U);
  EXPECT_EQ(warningsOf(0.03, 60, 8).front(),
            "/tmp/a.bag: the odometry's yaw drifts 8 times as fast as configured; with "
            "yaw_walk_deg_per_sqrt_s and yaw_walk_deg_per_sqrt_m times 8 the covariance counts "
            "with it from the first image on");
  EXPECT_EQ(warningsOf(0.13, 60, 8).size(), 2U);
  EXPECT_TRUE(warningsOf(0.03, 60, 1.4).empty()) << "no more than chance";
}

TEST(RunVerdict, DistrustAndFrozenOdometrySendToDoctor) {
  RunResult distrusted = runWith(36);
  for (std::size_t i = 0; i < 10; ++i) distrusted.frames[i].result.state = SlamState::kDistrusted;
  EXPECT_FALSE(sendsToDoctor(distrusted));  // a passing trouble
  for (std::size_t i = 0; i < 40; ++i) distrusted.frames[i].result.state = SlamState::kDistrusted;
  EXPECT_TRUE(sendsToDoctor(distrusted));
  RunResult frozen = runWith(36);
  frozen.odometry_froze = true;
  EXPECT_TRUE(sendsToDoctor(frozen));
}

}  // namespace
}  // namespace ardrone_vslam
