// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/msckf.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "support/point_flight.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kFocalLength_px = 500;
constexpr double kWindow_rad = 0.2;  // wide, but not yet that of a relocation

/// A lap of a room with true odometry, then 5 s without an image.
class FixAfterAGap : public ::testing::Test {
 protected:
  FixAfterAGap() : filter_({}, test::forwardExtrinsics()) {
    const test::Flight flight = test::lapsFlight(200, 2, 10);
    const std::vector<OdometryState> odometry = test::observeExactly(flight);
    test::PointWorld world(1);
    world.addRoom({10, 8, 3}, 1200);
    constexpr std::size_t kSeen = 200;
    constexpr std::size_t kAgain = kSeen + 50;
    filter_.start(odometry[0]);
    for (std::size_t i = 0; i < kSeen; ++i) {
      if (i > 0) filter_.predict(odometry[i]);
      const Eigen::Isometry3d T_map_cam = flight[i].T_map_base * test::forwardExtrinsics();
      for (const UsedTrack& used : filter_.track(world.look(T_map_cam, flight[i].stamp_ns), time_))
        seen_.push_back(used);
    }
    truth_ = flight[kAgain].T_map_base;
    OdometryState drifted = odometry[kAgain];
    drifted.T_odom_base.translation() += Eigen::Vector3d(0.15, -0.15, 0.05);
    filter_.predict(drifted);
  }

  Eigen::Vector3d bearingTo(const Eigen::Vector3d& point_map) const {
    return (truth_.inverse() * point_map - test::forwardExtrinsics().translation()).normalized();
  }

  Msckf filter_;
  FrameBudget time_;
  std::vector<UsedTrack> seen_;
  Eigen::Isometry3d truth_;
};

TEST_F(FixAfterAGap, LandmarksAllOverTheImageCorrectThePosition) {
  std::vector<LandmarkObservation> observations;
  for (const UsedTrack& used : seen_) {
    const Eigen::Vector3d& point_map = used.point.position_map;
    const double distance_m = (point_map - truth_.translation()).norm();
    const Eigen::Vector3d bearing = bearingTo(point_map);
    if (bearing.x() < 0.8 || std::sqrt(used.covariance_m2.trace()) > 0.1 * distance_m) continue;
    observations.push_back({bearing, point_map, used.covariance_m2, used.anchor_id, kWindow_rad});
  }
  ASSERT_GT(observations.size(), 20U);
  EXPECT_EQ(filter_.fix(observations, kFocalLength_px), FixOutcome::kApplied);
  EXPECT_LT((filter_.newest().position_map - truth_.translation()).norm(), 0.1);
}

TEST_F(FixAfterAGap, AFewThatAgreeBecauseTheyStandInGroupsDoNot) {
  const std::uint32_t anchor_id = filter_.state().anchors().front().id;
  RandomSource random(3);
  std::vector<LandmarkObservation> observations;
  // Corners of two things, taken for those of two others 4 degrees beside them.
  for (const double side_m : {-1.2, 1.2}) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d point_map =
          truth_ * Eigen::Vector3d(3, side_m, 0) + 0.01 * random.normal3();
      observations.push_back({rotationOf({0, 0, 0.07}) * bearingTo(point_map), point_map,
                              0.01 * 0.01 * Eigen::Matrix3d::Identity(), anchor_id, kWindow_rad});
    }
  }
  const Eigen::Vector3d before_map = filter_.newest().position_map;
  EXPECT_EQ(filter_.fix(observations, kFocalLength_px), FixOutcome::kNone);
  EXPECT_EQ(filter_.newest().position_map, before_map);
}

}  // namespace
}  // namespace ardrone_vslam
