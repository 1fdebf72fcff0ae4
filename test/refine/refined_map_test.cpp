// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refined_map.hpp"

#include <gtest/gtest.h>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

Eigen::Isometry3d turned(double yaw_rad, const Eigen::Vector3d& position) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotationAboutZ(yaw_rad);
  T.translation() = position;
  return T;
}

/// Two anchors at x = 1 and 2 with the landmarks 1 and 2, each a metre ahead.
SavedMap twoAnchors() {
  SavedMap map;
  map.anchor_covariance = Eigen::MatrixXd::Identity(14, 14);
  for (std::uint32_t i = 1; i <= 2; ++i) {
    MapAnchor anchor;
    anchor.stamp_ns = 100 * i;
    anchor.T_map_rig.translation().x() = i;
    map.anchors.push_back(anchor);
    Landmark landmark;
    landmark.id = i;
    landmark.anchor_id = i;
    landmark.position_map << i + 1, 0, 0;
    landmark.view_direction_map << 1, 0, 0;
    map.landmarks.push_back(landmark);
  }
  return map;
}

/// Keyframes at 50 ns and 150 ns, at x = 0 and 2 by the odometry and as fused; the frame at 100 ns
/// lies between.
FlightRecord twoKeyframes() {
  Keyframe first;
  Keyframe second;
  first.stamp_ns = 50;
  second.stamp_ns = 150;
  second.T_odom_base = second.T_map_base = turned(0, {2, 0, 0});
  second.passed = {{100, turned(0, {1, 0, 0})}};
  FlightRecord record;
  record.keyframes = {first, second};
  return record;
}

Refinement refinementOf(const Eigen::Isometry3d& first, const Eigen::Isometry3d& second) {
  Refinement refinement;
  refinement.T_map_base = {first, second};
  refinement.R_base_rig.assign(2, Eigen::Matrix3d::Identity());
  return refinement;
}

TEST(RefinedMap, LandmarksGoWithTheirAnchors) {
  Refinement refinement = refinementOf(turned(M_PI / 2, {0, 4, 0}), turned(M_PI / 2, {0, 6, 0}));
  SavedMap before = twoAnchors();
  before.flight = twoKeyframes();
  const SavedMap map = refinedMap(before, twoKeyframes(), refinement);
  EXPECT_TRUE(map.anchors[0].T_map_rig.isApprox(turned(M_PI / 2, {0, 5, 0})));
  EXPECT_TRUE(map.landmarks[0].position_map.isApprox(Eigen::Vector3d(0, 6, 0)));
  EXPECT_TRUE(map.landmarks[0].view_direction_map.isApprox(Eigen::Vector3f(0, 1, 0)));
  // The other anchor came after the last keyframe, and goes with the one before.
  EXPECT_TRUE(map.anchors[1].T_map_rig.isApprox(turned(M_PI / 2, {0, 6, 0})));
  EXPECT_TRUE(map.landmarks[1].position_map.isApprox(Eigen::Vector3d(0, 7, 0)));
  EXPECT_EQ(map.anchor_covariance, before.anchor_covariance);
  EXPECT_TRUE(map.flight.keyframes.empty());
}

TEST(RefinedMap, LandmarksWithAPointAreThere) {
  Refinement refinement = refinementOf(turned(0, {0, 0, 0}), turned(0, {2, 0, 0}));
  std::vector<TrackPoint3d>& points = refinement.points;
  points.resize(3);
  points[0].landmark_id = 2;
  points[0].position_map << 1, 1, 1;
  points[1].landmark_id = 0;  // a track that is no landmark
  points[2].landmark_id = 2;  // of all its tracks
  points[2].is_joint = true;
  points[2].position_map << 1, 1, 2;
  const SavedMap map = refinedMap(twoAnchors(), twoKeyframes(), refinement);
  EXPECT_TRUE(map.landmarks[0].position_map.isApprox(Eigen::Vector3d(2, 0, 0)));
  EXPECT_EQ(map.landmarks[1].position_map, Eigen::Vector3d(1, 1, 2));
}

TEST(RefinedMap, HasTheCovarianceOfTheRefinement) {
  Refinement refinement = refinementOf(turned(0, {0, 0, 0}), turned(0, {2, 0, 0}));
  refinement.anchor_covariance = 0.5 * Eigen::MatrixXd::Identity(14, 14);
  SavedMap before = twoAnchors();
  before.anchor_covariance(6, 6) = 0.25;
  // The second anchor is not in the record.
  EXPECT_EQ(refinedMap(before, twoKeyframes(), refinement).anchor_covariance,
            before.anchor_covariance);
  before.anchors[1].stamp_ns = 150;
  Eigen::MatrixXd expected = refinement.anchor_covariance;
  expected(13, 13) = 1;  // the stretch is the larger one
  EXPECT_EQ(refinedMap(before, twoKeyframes(), refinement).anchor_covariance, expected);
}

TEST(RefinedMap, WhatIsNotInTheRecordGoesWithTheAnchorBefore) {
  Refinement refinement = refinementOf(turned(0, {0, 3, 0}), turned(0, {2, 3, 0}));
  SavedMap before = twoAnchors();
  before.anchors[0].stamp_ns = 40;  // too early
  const SavedMap early = refinedMap(before, twoKeyframes(), refinement);
  EXPECT_EQ(early.anchors[0].T_map_rig.translation(), Eigen::Vector3d(1, 0, 0));
  before.anchors[0].stamp_ns = 50;
  before.anchors[1].stamp_ns = 60;  // in a gap
  const SavedMap gap = refinedMap(before, twoKeyframes(), refinement);
  EXPECT_TRUE(gap.anchors[1].T_map_rig.translation().isApprox(Eigen::Vector3d(1, 3, 0)));
}

TEST(RefinedMap, AnchorsAreTurnedByTheErrorOfTheExtrinsics) {
  Refinement refinement = refinementOf(turned(0, {0, 3, 0}), turned(0, {2, 3, 0}));
  refinement.R_base_rig[0] = turned(M_PI / 2, {0, 0, 0}).linear();  // another camera follows
  const SavedMap map = refinedMap(twoAnchors(), twoKeyframes(), refinement);
  EXPECT_TRUE(map.anchors[0].T_map_rig.isApprox(turned(M_PI / 2, {1, 3, 0})));  // between the two
  EXPECT_TRUE(map.landmarks[0].position_map.isApprox(Eigen::Vector3d(1, 4, 0)));
}

TEST(RefinedMap, WithoutKeyframesItStaysAsItIs) {
  const SavedMap map = refinedMap(twoAnchors(), {}, {});
  EXPECT_EQ(map.landmarks[0].position_map, Eigen::Vector3d(2, 0, 0));
}

}  // namespace
}  // namespace ardrone_vslam
