// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/re_anchoring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "ardrone_vslam/rotation.hpp"
#include "map/landmark_map.hpp"
#include "support/odometry_window.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kDistance_m = 5;
constexpr double kTolerance_rad = 1e-3;

/// Two frames; what is known of one, as an update of the filter would have it.
WindowState twoFrames() {
  OdometryWindow state;
  OdometryState odometry;
  odometry.stamp_ns = 1;
  state.add(odometry);
  odometry.stamp_ns = 1000000001;
  odometry.T_odom_base.translation().x() = 1;
  state.add(odometry);
  return state;
}

/// Moves the newest frame by about `moved_m` along y.
void correct(WindowState& state, double moved_m) {
  const int at = state.frameCoordinate(1) + 1;
  Information information({at});
  information.matrix(0, 0) = 1e12;
  information.vector(0) = 1e12 * moved_m;
  ASSERT_TRUE(state.update(information));
}

Landmark landmarkAt(const Eigen::Vector3d& position_map, std::uint32_t anchor_id) {
  Landmark landmark;
  landmark.position_map = position_map;
  landmark.view_direction_map = position_map.normalized().cast<float>();
  landmark.covariance_m2 = Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal());
  landmark.anchor_id = anchor_id;
  return landmark;
}

TEST(ReAnchoring, LandmarksStayWhereTheirAnchorSawThem) {
  WindowState state = twoFrames();
  ReAnchoring moves;
  const Clone placed = state.frames()[1];
  moves.begin(placed);
  Landmark landmark = landmarkAt({4, 1, 2}, placed.id);
  const Eigen::Vector3d seen_rig =
      placed.R_map_rig.transpose() * (landmark.position_map - placed.position_map);
  correct(state, 0.02);
  const auto found = moves.take(state, kDistance_m, kTolerance_rad);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].anchor_id, placed.id);
  found[0].apply(landmark);
  const Clone& now = state.frames()[1];
  EXPECT_GT((now.position_map - placed.position_map).norm(), 0.01);
  const Eigen::Vector3d expected =
      now.position_map + now.stretch / placed.stretch * (now.R_map_rig * seen_rig);
  EXPECT_LT((landmark.position_map - expected).norm(), 1e-12);
  EXPECT_EQ(landmark.anchor_id, placed.id);
  EXPECT_TRUE(moves.take(state, kDistance_m, kTolerance_rad).empty()) << "each move once";
}

TEST(ReAnchoring, SmallMovesWaitUntilTheyShow) {
  WindowState state = twoFrames();
  ReAnchoring moves;
  moves.begin(state.frames()[1]);
  const Eigen::Vector3d placed = state.frames()[1].position_map;
  correct(state, 0.003);
  EXPECT_TRUE(moves.take(state, kDistance_m, kTolerance_rad).empty());
  correct(state, 0.003);
  const auto found = moves.take(state, kDistance_m, kTolerance_rad);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].from_map, placed) << "the first one is not lost";
  EXPECT_EQ(found[0].to_map, state.frames()[1].position_map);
}

TEST(ReAnchoring, LandmarksOfAJoinedAnchorGoToTheOther) {
  WindowState state = twoFrames();
  ReAnchoring moves;
  moves.begin(state.frames()[0]);
  moves.begin(state.frames()[1]);
  Landmark landmark = landmarkAt({4, 1, 2}, state.frames()[1].id);
  moves.join(state.frames()[1], state.frames()[0].id);
  const auto found = moves.take(state, kDistance_m, kTolerance_rad);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].anchor_id, state.frames()[1].id);
  found[0].apply(landmark);
  EXPECT_EQ(landmark.anchor_id, state.frames()[0].id);
  EXPECT_LT((landmark.position_map - Eigen::Vector3d(4, 1, 2)).norm(), 1e-12) << "where it was";
}

TEST(ReAnchoring, TurnAndStretchHoldForAllThatALandmarkKnows) {
  AnchorCorrection move;
  move.from_map << 1, 0, 0;
  move.to_map << 1, 1, 0;
  move.rotation = rotationOf({0, 0, M_PI / 2});
  move.stretch = 2;
  Landmark landmark = landmarkAt({2, 0, 0}, 7);
  move.apply(landmark);
  EXPECT_LT((landmark.position_map - Eigen::Vector3d(1, 3, 0)).norm(), 1e-12);
  EXPECT_LT((landmark.view_direction_map - Eigen::Vector3f::UnitY()).norm(), 1e-6);
  EXPECT_LT((landmark.covariance_m2.full().diagonal() - Eigen::Vector3d(8, 4, 12)).norm(), 1e-12);
}

}  // namespace
}  // namespace ardrone_vslam
