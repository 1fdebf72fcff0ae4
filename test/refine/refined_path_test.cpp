// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_path.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Isometry3d at(double x_m) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = x_m;
  return T;
}

/// Frames at 0, 1, 2 ... s; odometry goes 1 m/s, fused poses are 100 m further.
RunResult straightRun(int frames, const std::vector<int>& keyframes) {
  RunResult run;
  for (int i = 0; i < frames; ++i) {
    RunFrame frame;
    frame.result.stamp_ns = 1'000'000'000LL * (i + 1);
    frame.result.T_odom_base = at(i);
    frame.result.T_map_base = at(100 + i);
    run.frames.push_back(frame);
  }
  for (const int i : keyframes) {
    Keyframe keyframe;
    keyframe.stamp_ns = run.frames[static_cast<std::size_t>(i)].result.stamp_ns;
    run.record.keyframes.push_back(keyframe);
  }
  return run;
}

std::vector<double> xOf(const std::vector<Eigen::Isometry3d>& path) {
  std::vector<double> x_m;
  x_m.reserve(path.size());
  for (const Eigen::Isometry3d& T : path) x_m.push_back(T.translation().x());
  return x_m;
}

TEST(RefinedPath, IsTheOdometrysBetweenKeyframesWithTheRestSpread) {
  const RunResult run = straightRun(8, {1, 5});
  Refinement refinement;
  refinement.T_map_base = {at(10), at(18)};  // twice as far as the odometry says
  const std::vector<double> x_m = xOf(refinedPath(run, refinement));
  const std::vector<double> expected{100, 10, 12, 14, 16, 18, 19, 20};
  ASSERT_EQ(x_m.size(), expected.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) EXPECT_NEAR(x_m[i], expected[i], 1e-9) << i;
}

TEST(RefinedPath, WhileTheCameraRestsTheFusedPoseHolds) {
  RunResult run = straightRun(6, {0, 5});
  for (std::size_t i = 1; i < 5; ++i) {
    run.frames[i].result.state = SlamState::kResting;
    run.frames[i].result.T_map_base = at(150);  // corrected as the rest began
  }
  Refinement refinement;
  refinement.T_map_base = {at(0), at(2)};
  const std::vector<double> x_m = xOf(refinedPath(run, refinement));
  const std::vector<double> expected{0, 1, 1, 1, 1, 2};
  ASSERT_EQ(x_m.size(), expected.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) EXPECT_NEAR(x_m[i], expected[i], 1e-9) << i;
}

TEST(RefinedPath, JumpsOfTheOdometryAreNoWay) {
  RunResult run = straightRun(5, {0, 4});
  for (std::size_t i = 2; i < 5; ++i)
    run.frames[i].result.T_odom_base = at(30.0 + static_cast<double>(i));
  run.frames[2].result.odometry_step_m = 30;
  Refinement refinement;
  refinement.T_map_base = {at(0), at(4)};
  EXPECT_NEAR(xOf(refinedPath(run, refinement))[1], 1, 1e-9);
  EXPECT_NEAR(xOf(refinedPath(run, refinement))[3], 3, 1e-9);
}

TEST(RefinedPath, TurnsAreSpreadAsWell) {
  const RunResult run = straightRun(5, {0, 4});
  Refinement refinement;
  refinement.T_map_base = {at(0), at(4)};
  refinement.T_map_base[1].linear() = rotationAboutZ(0.4);
  const auto path = refinedPath(run, refinement);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_NEAR(yawOf(path[i].linear()), 0.1 * static_cast<double>(i), 1e-9);
}

TEST(RefinedPath, WithoutKeyframesItIsTheFusedOne) {
  const RunResult run = straightRun(3, {});
  EXPECT_EQ(xOf(refinedPath(run, {})), (std::vector<double>{100, 101, 102}));
}

}  // namespace
}  // namespace ardrone_vslam
