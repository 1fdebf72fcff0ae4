// SPDX-License-Identifier: BSD-3-Clause
// What becomes of pose and map while the set-up has a fault.
#include <gtest/gtest.h>

#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFaultRate_hz = 15;

SetupFinding mirrored() {
  SetupFinding finding;
  finding.fault = SetupFault::kMirrored;
  return finding;
}

SetupFinding confirmed() {
  SetupFinding finding;
  finding.is_confirmed = true;
  return finding;
}

class SetupFaultWorld : public testing::TestWithParam<EstimatorKind> {
 protected:
  SetupFaultWorld()
      : world_(test::pointRoom(1)),
        flight_(test::lapsFlight(225, 2, kFaultRate_hz)),
        images_(test::film(world_, flight_)),
        odometry_(test::observe(flight_, {0.03, 0.05}, 1)) {
    config_.estimator = GetParam();
    slam_ = std::make_unique<Slam>(config_, test::forwardExtrinsics());
  }

  /// The frames first .. last - 1, with what is known of the set-up. @return the last result
  FrameResult fly(std::size_t first, std::size_t last, const SetupFinding& finding) {
    FrameResult result;
    for (std::size_t i = first; i < last; ++i) {
      slam_->heed(finding);
      result = slam_->process(images_[i], odometry_[i]);
    }
    return result;
  }

  PointWorld world_;
  test::Flight flight_;
  std::vector<ImageFeatures> images_;
  std::vector<OdometryState> odometry_;
  SlamConfig config_;
  std::unique_ptr<Slam> slam_;
};

TEST_P(SetupFaultWorld, ThePoseFollowsTheOdometryAndItsStateSaysSo) {
  ASSERT_GT(fly(0, 100, {}).landmarks, 0);
  const FrameResult first = fly(100, 101, mirrored());
  const FrameResult last = fly(101, 200, mirrored());
  EXPECT_EQ(last.state, SlamState::kDistrusted);
  EXPECT_EQ(last.new_landmarks, 0);
  const Eigen::Vector3d displacement =
      last.T_map_base.translation() - first.T_map_base.translation();
  const Eigen::Vector3d told = last.T_odom_base.translation() - first.T_odom_base.translation();
  EXPECT_LT((displacement - told).norm(), 1e-6);
  EXPECT_GT(last.covariance(0, 0), first.covariance(0, 0));
}

TEST_P(SetupFaultWorld, TheCameraIsUsedAgainWhenTheFaultEnds) {
  fly(0, 60, mirrored());
  EXPECT_GT(fly(60, 200, {}).landmarks, 0);
  EXPECT_NE(fly(200, 201, {}).state, SlamState::kDistrusted);
}

INSTANTIATE_TEST_SUITE_P(Estimators, SetupFaultWorld,
                         testing::Values(EstimatorKind::kMsckf, EstimatorKind::kThesis),
                         [](const auto& estimator) {
                           return std::string(nameOf(estimator.param));
                         });

using MsckfSetupFaultWorld = SetupFaultWorld;

TEST_P(MsckfSetupFaultWorld, WhatWasNeverConfirmedIsTakenBack) {
  ASSERT_GT(fly(0, 100, {}).landmarks, 0);
  const FrameResult result = fly(100, 101, mirrored());
  EXPECT_EQ(result.landmarks, 0);
  EXPECT_LT((result.T_map_base.translation() - result.T_odom_base.translation()).norm(), 1e-9);
  EXPECT_TRUE(slam_->landmarks().empty());
}

TEST_P(MsckfSetupFaultWorld, ForgottenImagesLeaveAnUncertainPoseAndNoLandmark) {
  const FrameResult before = fly(0, 100, confirmed());
  ASSERT_GT(before.landmarks, 0);
  const Eigen::Vector3d corrected =
      before.T_map_base.translation() - before.T_odom_base.translation();
  ASSERT_GT(corrected.norm(), 0.01);
  SetupFinding forgetful = confirmed();
  forgetful.forgets_images = true;
  const FrameResult after = fly(100, 101, forgetful);
  EXPECT_EQ(after.state, SlamState::kDistrusted);
  EXPECT_TRUE(slam_->landmarks().empty());
  const Eigen::Vector3d displacement =
      after.T_map_base.translation() - before.T_map_base.translation();
  const Eigen::Vector3d told = after.T_odom_base.translation() - before.T_odom_base.translation();
  EXPECT_LT((displacement - told).norm(), 0.001) << "the pose goes on where it was";
  const Eigen::Vector3d axis = corrected.normalized();
  const double variance_m2 = axis.dot(after.covariance.topLeftCorner<3, 3>() * axis);
  EXPECT_GT(variance_m2, corrected.squaredNorm());
  EXPECT_GT(fly(101, 200, confirmed()).landmarks, 0) << "the camera is used again";
}

TEST_P(MsckfSetupFaultWorld, WhatWasConfirmedStays) {
  const FrameResult kept = fly(0, 300, confirmed());
  const Eigen::Isometry3d T_map_odom = slam_->T_map_odom();
  ASSERT_GT((kept.T_map_base.translation() - kept.T_odom_base.translation()).norm(), 0.02);
  fly(300, 320, {});
  const FrameResult result = fly(320, 321, mirrored());
  EXPECT_EQ(result.landmarks, kept.landmarks);
  EXPECT_LT((slam_->T_map_odom().translation() - T_map_odom.translation()).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MsckfSetupFaultWorld, testing::Values(EstimatorKind::kMsckf),
                         [](const auto& estimator) {
                           return std::string(nameOf(estimator.param));
                         });

}  // namespace
}  // namespace ardrone_vslam
