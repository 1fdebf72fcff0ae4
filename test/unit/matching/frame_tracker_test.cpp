// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/frame_tracker.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "support/point_world.hpp"

namespace ardrone_vslam {
namespace {

using test::PointWorld;

class FrameTrackerTest : public ::testing::Test {
 protected:
  FrameTrackerTest() : maker_(1) {}

  ImageFeatures frame() { return maker_.emptyView(0); }
  void add(ImageFeatures& features, float x_px, float y_px, const Descriptor& descriptor) {
    features.pixel_px.emplace_back(x_px, y_px);
    features.bearing_cam.emplace_back(0.F, 0.F, 1.F);
    features.score.push_back(1);
    features.descriptor.push_back(descriptor);
  }

  PointWorld maker_;  // of descriptors
};

TEST_F(FrameTrackerTest, CarriesTracksOnAndCountsTheirAge) {
  const Descriptor a = maker_.randomDescriptor();
  const Descriptor b = maker_.randomDescriptor();
  FrameTracker tracker({});
  ImageFeatures first = frame();
  add(first, 100, 100, a);
  add(first, 110, 100, b);
  tracker.assign(first);
  EXPECT_EQ(first.age_frames, (std::vector<std::uint16_t>{0, 0}));
  ASSERT_NE(first.track_id[0], first.track_id[1]);
  EXPECT_NE(first.track_id[0], kNoTrack);

  ImageFeatures second = frame();  // in the other order, moved, with noise
  add(second, 130, 100, maker_.flipped(b, 40));
  add(second, 120, 100, maker_.flipped(a, 40));
  tracker.assign(second);
  EXPECT_EQ(second.track_id[0], first.track_id[1]);
  EXPECT_EQ(second.track_id[1], first.track_id[0]);
  EXPECT_EQ(second.age_frames, (std::vector<std::uint16_t>{1, 1}));
}

TEST_F(FrameTrackerTest, AFeatureThatWasAwayIsANewTrack) {
  const Descriptor a = maker_.randomDescriptor();
  FrameTracker tracker({});
  std::set<std::uint32_t> ids;
  for (int i = 0; i < 3; ++i) {
    ImageFeatures with = frame();
    add(with, 100, 100, a);
    tracker.assign(with);
    EXPECT_TRUE(ids.insert(with.track_id[0]).second) << "an id was used again";
    EXPECT_EQ(with.age_frames[0], 0);
    ImageFeatures without = frame();
    tracker.assign(without);
    EXPECT_TRUE(without.track_id.empty());
  }
}

TEST_F(FrameTrackerTest, ATrackerThatCarriesOnUsesNoIdAgain) {
  FrameTracker before({}, 1000);
  ImageFeatures first = frame();
  add(first, 100, 100, maker_.randomDescriptor());
  add(first, 300, 100, maker_.randomDescriptor());
  before.assign(first);
  EXPECT_EQ(first.track_id, (std::vector<std::uint32_t>{1000, 1001}));

  FrameTracker after({}, before.nextTrackId());
  ImageFeatures second = first;  // the same features: to a new tracker they are new tracks
  after.assign(second);
  EXPECT_EQ(second.track_id, (std::vector<std::uint32_t>{1002, 1003}));
}

TEST_F(FrameTrackerTest, IdsThatRunOverLeaveOutNoTrack) {
  FrameTracker tracker({}, std::numeric_limits<std::uint32_t>::max());
  ImageFeatures features = frame();
  add(features, 100, 100, maker_.randomDescriptor());
  add(features, 300, 100, maker_.randomDescriptor());
  tracker.assign(features);
  EXPECT_EQ(features.track_id,
            (std::vector<std::uint32_t>{std::numeric_limits<std::uint32_t>::max(), 1}));
}

TEST_F(FrameTrackerTest, SearchesWithinTheRadiusOnly) {
  const Descriptor a = maker_.randomDescriptor();
  FrameTrackerConfig config;
  config.search_radius_px = 50;
  for (const float x_px : {150.0F, 150.5F}) {
    FrameTracker tracker(config);
    ImageFeatures first = frame();
    add(first, 100, 100, a);
    tracker.assign(first);
    ImageFeatures second = frame();
    add(second, x_px, 100, a);
    tracker.assign(second);
    EXPECT_EQ(second.track_id[0] == first.track_id[0], x_px == 150.0F) << x_px;
  }
}

TEST_F(FrameTrackerTest, DescriptorMustBeNearAndClearlyNearer) {
  const Descriptor a = maker_.randomDescriptor();
  FrameTrackerConfig config;
  config.max_hamming_bits = 100;
  config.ratio = 0.8;
  const auto isTracked = [&](const std::vector<Descriptor>& before) {
    FrameTracker tracker(config);
    ImageFeatures first = frame();
    for (std::size_t i = 0; i < before.size(); ++i)
      add(first, 100 + 5 * static_cast<float>(i), 100, before[i]);
    tracker.assign(first);
    ImageFeatures second = frame();
    add(second, 102, 100, a);
    tracker.assign(second);
    return second.age_frames[0] == 1;
  };
  EXPECT_TRUE(isTracked({maker_.flipped(a, 100)}));
  EXPECT_FALSE(isTracked({maker_.flipped(a, 101)}));
  EXPECT_TRUE(isTracked({maker_.flipped(a, 40), maker_.flipped(a, 51)}));
  EXPECT_FALSE(isTracked({maker_.flipped(a, 40), maker_.flipped(a, 49)})) << "ambiguous";
}

TEST_F(FrameTrackerTest, OnlyMutualBestMatchesCarryATrack) {
  const Descriptor a = maker_.randomDescriptor();
  FrameTracker tracker({});
  ImageFeatures first = frame();
  add(first, 100, 100, a);
  tracker.assign(first);
  ImageFeatures second = frame();  // both look like the same earlier feature, the second one more
  add(second, 101, 100, maker_.flipped(a, 30));
  add(second, 102, 100, maker_.flipped(a, 10));
  tracker.assign(second);
  EXPECT_NE(second.track_id[0], first.track_id[0]);
  EXPECT_EQ(second.track_id[1], first.track_id[0]);
}

TEST_F(FrameTrackerTest, AgeSaturates) {
  const Descriptor a = maker_.randomDescriptor();
  FrameTracker tracker({});
  ImageFeatures features;
  constexpr int kOldest = std::numeric_limits<std::uint16_t>::max();
  for (int i = 0; i <= kOldest + 2; ++i) {
    features = frame();
    add(features, 100, 100, a);
    tracker.assign(features);
    ASSERT_EQ(features.age_frames[0], std::min(i, kOldest));
  }
}

}  // namespace
}  // namespace ardrone_vslam
