// SPDX-License-Identifier: BSD-3-Clause
#include "map/feature_map.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

MapFeature featureOf(std::uint32_t track_id, std::int64_t stamp_ns) {
  MapFeature feature;
  feature.track_id = track_id;
  feature.stamp_ns = stamp_ns;
  return feature;
}

TEST(FeatureMap, FindsByTrackUntilRemoved) {
  FeatureMap map({});
  map.add(featureOf(7, 0));
  map.add(featureOf(9, 0));
  EXPECT_EQ(map.indexOfTrack(7), 0);
  EXPECT_EQ(map.indexOfTrack(9), 1);
  EXPECT_EQ(map.indexOfTrack(8), -1);
  map.remove(0);
  EXPECT_EQ(map.indexOfTrack(7), -1);
  EXPECT_EQ(map.all()[1].track_id, 9U) << "indices stay until compact";
  EXPECT_EQ(map.compact(0), 0) << "what was removed on purpose was not dropped";
  EXPECT_EQ(map.indexOfTrack(9), 0);
  EXPECT_EQ(map.size(), 1U);
}

TEST(FeatureMap, DropsWhatIsTooOld) {
  FeatureMapConfig config;
  config.max_feature_age_s = 2;
  FeatureMap map(config);
  map.add(featureOf(1, 0));
  map.add(featureOf(2, 1));
  EXPECT_EQ(map.compact(2 * kSecond_ns), 0);
  EXPECT_EQ(map.compact(2 * kSecond_ns + 1), 1);
  EXPECT_EQ(map.indexOfTrack(1), -1);
  EXPECT_EQ(map.indexOfTrack(2), 0);
}

TEST(FeatureMap, CapDropsTheOldestAndCountsOnlyWhatIsLeft) {
  FeatureMapConfig config;
  config.max_map_features = 3;
  FeatureMap map(config);
  for (std::uint32_t track = 1; track <= 6; ++track) map.add(featureOf(track, track));
  map.remove(1);  // track 2: leaves on its own
  EXPECT_EQ(map.compact(10), 2);
  ASSERT_EQ(map.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(map.all()[i].track_id, i + 4);
}

// After an epipolar mismatch (5.44) the track's feature is stored anew.
TEST(FeatureMap, ATrackThatLeftItsPointNeverFindsTheOldEntryAgain) {
  FeatureMap map({});
  map.add(featureOf(5, 1));
  map.add(featureOf(5, 2));
  EXPECT_EQ(map.indexOfTrack(5), 1);
  EXPECT_EQ(map.all()[0].track_id, kNoTrack);
  map.remove(1);  // the new entry has become a landmark
  EXPECT_EQ(map.indexOfTrack(5), -1);
  map.compact(3);
  ASSERT_EQ(map.size(), 1U) << "the old entry still waits for a match by descriptor";
  EXPECT_EQ(map.indexOfTrack(5), -1);
  EXPECT_EQ(map.indexOfTrack(kNoTrack), -1);
}

}  // namespace
}  // namespace ardrone_vslam
