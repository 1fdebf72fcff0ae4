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

TEST(RefinedMap, LandmarksGoWithTheirAnchors) {
  const Eigen::Isometry3d first = turned(M_PI / 2, {0, 5, 0});
  const SavedMap map = refinedMap(twoAnchors(), {{100, first}, {150, turned(1, {9, 9, 9})}}, {});
  EXPECT_TRUE(map.anchors[0].T_map_rig.isApprox(first));
  EXPECT_TRUE(map.landmarks[0].position_map.isApprox(Eigen::Vector3d(0, 6, 0)));
  EXPECT_TRUE(map.landmarks[0].view_direction_map.isApprox(Eigen::Vector3d(0, 1, 0)));
  // The other anchor is of an earlier flight.
  EXPECT_TRUE(map.landmarks[1].position_map.isApprox(Eigen::Vector3d(3, 0, 0)));
  EXPECT_EQ(map.anchor_covariance, twoAnchors().anchor_covariance);
}

TEST(RefinedMap, LandmarksWithAPointAreThere) {
  std::vector<TrackPoint3d> points(3);
  points[0].landmark_id = 2;
  points[0].position_map << 1, 1, 1;
  points[1].landmark_id = 0;  // a track that is no landmark
  points[2].landmark_id = 2;  // of all its tracks
  points[2].is_joint = true;
  points[2].position_map << 1, 1, 2;
  const SavedMap map = refinedMap(twoAnchors(), {}, points);
  EXPECT_EQ(map.landmarks[0].position_map, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(map.landmarks[1].position_map, Eigen::Vector3d(1, 1, 2));
}

}  // namespace
}  // namespace ardrone_vslam
