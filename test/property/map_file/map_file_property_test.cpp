// SPDX-License-Identifier: BSD-3-Clause
// Random maps come back as they were; of damage test/fuzz/map_file.cpp knows.
#include <gtest/gtest.h>

#include "support/read_file.hpp"
#include "support/seeds.hpp"
#include "support/temporary_folder.hpp"
#include "unit/map_file/map_files.hpp"

namespace ardrone_vslam::test {
namespace {

void expectSame(const Landmark& a, const Landmark& b) {
  EXPECT_EQ(a.descriptor, b.descriptor);
  EXPECT_EQ(a.position_map, b.position_map);
  EXPECT_EQ(a.covariance_m2.full(), b.covariance_m2.full());
  EXPECT_EQ(a.view_direction_map, b.view_direction_map);
  EXPECT_EQ(a.seen_distance_m, b.seen_distance_m);
  EXPECT_EQ(a.sigma_m, b.sigma_m);
  EXPECT_EQ(a.depth_sigma_m, b.depth_sigma_m);
  EXPECT_EQ(a.parallax_rad, b.parallax_rad);
  EXPECT_EQ(a.anchor_id, b.anchor_id);
  EXPECT_EQ(a.times_seen, b.times_seen);
  EXPECT_EQ(a.times_failed, b.times_failed);
  EXPECT_EQ(a.first_seen_ns, b.first_seen_ns);
  EXPECT_EQ(a.last_seen_ns, b.last_seen_ns);
}

void expectSame(const SavedMap& a, const SavedMap& b) {
  EXPECT_EQ(a.frame_id, b.frame_id);
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  EXPECT_EQ(a.cameras[0].focal_length_px, b.cameras[0].focal_length_px);
  EXPECT_EQ(a.anchor_covariance, b.anchor_covariance);
  ASSERT_EQ(a.anchors.size(), b.anchors.size());
  for (std::size_t i = 0; i < a.anchors.size(); ++i) {
    EXPECT_EQ(a.anchors[i].stamp_ns, b.anchors[i].stamp_ns);
    EXPECT_EQ(a.anchors[i].T_map_rig.translation(), b.anchors[i].T_map_rig.translation());
    EXPECT_TRUE(a.anchors[i].T_map_rig.isApprox(b.anchors[i].T_map_rig, 1e-12));
  }
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) expectSame(a.landmarks[i], b.landmarks[i]);
}

TEST(MapFileProperty, WhatIsReadIsWhatWasWrittenAndIsWrittenAsTheSameBytes) {
  const TemporaryFolder folder;
  const std::string first = folder.file("first.vmap");
  const std::string second = folder.file("second.vmap");
  for (const std::uint64_t seed : seeds()) {
    RandomSource random(seed);
    for (int i = 0; i < 30; ++i) {
      const SavedMap map = randomMap(random);
      ASSERT_EQ(writeMap(first, map), map.landmarks.size());
      const SavedMap loaded = readMap(first);
      expectSame(map, loaded);
      ASSERT_EQ(writeMap(second, loaded), loaded.landmarks.size());
      ASSERT_TRUE(readFile(second) == readFile(first)) << "seed " << seed << ", map " << i;
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
