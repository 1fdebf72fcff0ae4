// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/fixed_map.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

constexpr double kFar_m = 10;

/// Two anchors: of the first the heading errs, of the second the position.
SavedMap mapOfTwoAnchors() {
  SavedMap map;
  map.anchors.resize(2);
  map.anchors[1].T_map_rig.translation().x() = kFar_m;
  map.anchor_covariance.setZero(14, 14);
  map.anchor_covariance(5, 5) = 0.01 * 0.01;
  map.anchor_covariance.block<3, 3>(7, 7).diagonal().setConstant(0.2 * 0.2);
  map.anchor_covariance(13, 13) = 0.06 * 0.06;
  map.landmarks.resize(2);
  for (std::uint32_t i = 0; i < 2; ++i) {
    map.landmarks[i].id = i + 1;
    map.landmarks[i].anchor_id = i + 1;
  }
  return map;
}

TEST(FixedMap, IsExactForTheFilterAndSavedAsItWas) {
  SavedMap map = mapOfTwoAnchors();
  MapEntry entry;
  entry.anchor = 1;
  const FixedMap fixed(map, entry);
  EXPECT_EQ(entry.anchor, 0U);
  ASSERT_EQ(map.anchors.size(), 1U);
  EXPECT_TRUE(map.anchor_covariance.isZero(0));
  EXPECT_EQ(map.anchor_covariance.rows(), SavedMap::kAnchor);
  ASSERT_EQ(map.landmarks.size(), 2U);
  for (const Landmark& landmark : map.landmarks) EXPECT_EQ(landmark.anchor_id, 1U);

  const SavedMap saved = fixed.snapshotWith(map.landmarks, 7).map();
  const SavedMap before = mapOfTwoAnchors();
  EXPECT_EQ(saved.stamp_ns, 7);
  ASSERT_EQ(saved.anchors.size(), 2U);
  EXPECT_EQ(saved.anchors[1].T_map_rig.matrix(), before.anchors[1].T_map_rig.matrix());
  EXPECT_EQ(saved.anchor_covariance, before.anchor_covariance);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(saved.landmarks[i].anchor_id, before.landmarks[i].anchor_id);
}

Estimate at(const Eigen::Vector3d& position_map, const FixedMap& fixed) {
  Estimate estimate;
  estimate.T_map_base.translation() = position_map;
  estimate.covariance.diagonal().setConstant(1);
  estimate.scale_sigma = 0.04;
  fixed.addErrors(estimate);
  estimate.covariance.diagonal().array() -= 1;
  return estimate;
}

TEST(FixedMap, APoseErrsWithTheNearestAnchor) {
  SavedMap map = mapOfTwoAnchors();
  MapEntry entry;
  const FixedMap fixed(map, entry);
  const Estimate near_first = at({4, 0, 0}, fixed);
  constexpr double kNear = 1e-15;
  EXPECT_NEAR(near_first.covariance(1, 1), 0.04 * 0.04, kNear) << "4 m times the heading's";
  EXPECT_NEAR(near_first.covariance(5, 5), 0.01 * 0.01, kNear);
  EXPECT_NEAR(near_first.covariance(1, 5), 4 * 0.01 * 0.01, kNear) << "they err together";
  EXPECT_NEAR(near_first.covariance(0, 0), 0, kNear);
  EXPECT_DOUBLE_EQ(near_first.scale_sigma, 0.04);
  const Estimate near_second = at({kFar_m, 2, 0}, fixed);
  EXPECT_NEAR(near_second.covariance(0, 0), 0.2 * 0.2, kNear);
  EXPECT_NEAR(near_second.covariance(1, 1), 0.2 * 0.2 + 0.12 * 0.12, kNear) << "2 m of its scale";
  EXPECT_DOUBLE_EQ(near_second.scale_sigma, 0.06);
}

}  // namespace
}  // namespace ardrone_vslam
