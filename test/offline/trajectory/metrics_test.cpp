// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/truth_paths.hpp"

namespace ardrone_vslam {
namespace {

using test::straightPath;

TEST(Metrics, ErrorsAreDistancesWithoutAlignment) {
  Trajectory truth;
  Trajectory estimate;
  const std::vector<Eigen::Vector3d> offsets{{0, 0, 0}, {3, 4, 0}, {0, 0, -2}};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    StampedPose pose;
    pose.stamp_ns = static_cast<std::int64_t>(i);
    pose.T_frame_body.translation() << 10, 20, static_cast<double>(i);
    truth.append(pose);
    pose.T_frame_body.translation() += offsets[i];
    estimate.append(pose);
  }
  const auto errors = positionErrors_m(estimate, truth);
  EXPECT_EQ(errors, (std::vector<double>{0, 5, 2}));
  const ErrorSummary summary = summarise(errors);
  EXPECT_NEAR(summary.rmse_m, std::sqrt(29.0 / 3), 1e-12);
  EXPECT_NEAR(summary.mean_m, 7.0 / 3, 1e-12);
  EXPECT_EQ(summary.max_m, 5);
  EXPECT_EQ(summarise({}).rmse_m, 0);
}

TEST(Metrics, AlignmentTakesOutMotionAndTurnButNotScale) {
  Trajectory truth;
  Trajectory moved;
  Trajectory larger;
  Eigen::Isometry3d T_there_here = Eigen::Isometry3d::Identity();
  T_there_here.linear() = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  T_there_here.translation() << 5, -6, 7;
  for (int i = 0; i < 40; ++i) {
    StampedPose pose;
    pose.stamp_ns = i;
    pose.T_frame_body.translation() << std::cos(0.3 * i), std::sin(0.5 * i), 0.1 * i;
    truth.append(pose);
    moved.append({i, T_there_here * pose.T_frame_body});
    pose.T_frame_body.translation() *= 1.1;
    larger.append(pose);
  }
  EXPECT_NEAR(alignedRmse_m(moved, truth), 0, 1e-9);
  EXPECT_GT(alignedRmse_m(larger, truth), 0.05);
  EXPECT_LT(alignedRmse_m(larger, truth), summarise(positionErrors_m(larger, truth)).rmse_m);
  EXPECT_EQ(alignedRmse_m({}, {}), 0);
}

TEST(Metrics, ScaledTruthIsAboutItsStart) {
  Trajectory truth;
  for (const double x : {2.0, 4.0}) {
    StampedPose pose;
    pose.stamp_ns = static_cast<std::int64_t>(x);
    pose.T_frame_body.translation() << x, 1, 0;
    truth.append(pose);
  }
  const Trajectory longer = scaled(truth, 0.5);
  EXPECT_EQ(longer.poses()[0].T_frame_body.translation(), Eigen::Vector3d(2, 1, 0));
  EXPECT_EQ(longer.poses()[1].T_frame_body.translation(), Eigen::Vector3d(5, 1, 0));
  EXPECT_TRUE(scaled({}, 0.1).empty());
}

TEST(Metrics, OnePercentOfScaleIsOnePercentOfTranslation) {
  const auto t_rel =
      translationError_percent(straightPath(10000, 1.01 * 0.1), straightPath(10000, 0.1));
  ASSERT_TRUE(t_rel);
  EXPECT_NEAR(*t_rel, 1.0, 0.002);
  EXPECT_NEAR(*translationError_percent(straightPath(10000, 0.1), straightPath(10000, 0.1)), 0,
              1e-12);
}

TEST(Metrics, TranslationErrorNeedsAHundredMetres) {
  EXPECT_FALSE(translationError_percent(straightPath(100, 1), straightPath(100, 1)));
  EXPECT_TRUE(translationError_percent(straightPath(103, 1), straightPath(103, 1)));
  EXPECT_FALSE(translationError_percent({}, {}));
}

TEST(Metrics, TranslationErrorDoesNotCountATurnOfTheWholePath) {
  Trajectory turned;
  const Trajectory truth = straightPath(300, 1);
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()));
  for (const StampedPose& pose : truth.poses())
    turned.append({pose.stamp_ns, turn * pose.T_frame_body});
  EXPECT_NEAR(*translationError_percent(turned, truth), 0, 1e-9);
}

TEST(Metrics, ATurnWithinAPathShowsAsTheChordBetweenBothEnds) {
  // The estimate's attitude is off by a constant: motion expressed in its own frame turns by it.
  Trajectory estimate;
  const double angle_rad = 0.01;
  const Trajectory truth = straightPath(102, 1);
  for (StampedPose pose : truth.poses()) {
    pose.T_frame_body.linear() =
        Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    estimate.append(pose);
  }
  // One sub-path, of 101 m: chord 2 * 101 sin(angle / 2) over 100 m.
  EXPECT_NEAR(*translationError_percent(estimate, truth), 202 * std::sin(angle_rad / 2), 1e-9);
}

TEST(Metrics, NeesIsTheErrorInUnitsOfItsCovariance) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.diagonal() << 4, 1, 0.25;
  EXPECT_NEAR(nees({2, 1, 0.5}, covariance), 3, 1e-12);
  EXPECT_NEAR(nees({4, 0, 0}, covariance), 4, 1e-12);
}

TEST(Metrics, QuantilesInterpolate) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({4, 1, 2, 3}, 0.5), 2.5);
  EXPECT_EQ(quantile({5, 1}, 0), 1);
  EXPECT_EQ(quantile({5, 1}, 1), 5);
  EXPECT_NEAR(quantile({0, 10}, 0.95), 9.5, 1e-12);
  EXPECT_EQ(quantile({7}, 0.3), 7);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

}  // namespace
}  // namespace ardrone_vslam
