// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/image_parts.hpp"

#include <gtest/gtest.h>

#include "support/view_builder.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr double kDepth_m = 4;
constexpr double kMinAge_s = 3;

TEST(ImageParts, AreFourByThreeOfAllThatWasShown) {
  ViewBuilder builder;
  builder.lookFrom({0, 0, 0});
  builder.addPixel(-320, -180, 1);
  builder.addPixel(320, 180, 2);
  const FrameView& view = builder.view();
  EXPECT_EQ(partOf({-320, -180}, view), 0U);
  EXPECT_EQ(partOf({-161, -61}, view), 0U);
  EXPECT_EQ(partOf({-159, -61}, view), 1U);
  EXPECT_EQ(partOf({-161, -59}, view), 4U);
  EXPECT_EQ(partOf({320, 180}, view), kImageParts - 1);
  EXPECT_EQ(partOf({1000, 1000}, view), kImageParts - 1);
}

class KnownPartsTest : public ::testing::Test {
 protected:
  KnownPartsTest() {
    builder_.lookFrom({0, 0, 0});
    builder_.addFrame();
    now_ns_ = builder_.features().stamp_ns = 100'000'000'000;
  }

  static Eigen::Vector3d at(double right_px, double down_px) {
    return {kDepth_m, -right_px / kPointFocalLength_px * kDepth_m,
            -down_px / kPointFocalLength_px * kDepth_m};
  }
  /// So many landmarks of an age, recognised around an ideal pixel.
  void recognise(int count, double right_px, double down_px, double age_s) {
    for (int i = 0; i < count; ++i) {
      Landmark landmark;
      landmark.position_map = at(right_px + i, down_px);
      landmark.first_seen_ns = now_ns_ - static_cast<std::int64_t>(age_s * 1e9);
      const int target = static_cast<int>(map_.size());
      map_.add(landmark);
      matches_.push_back({target, builder_.addPixel(right_px + i, down_px, kNoTrack)});
    }
  }
  bool isKnownAt(double right_px, double down_px) {
    const FrameView& view = builder_.view();
    return isSeenIn(knownParts(view, matches_, kMinAge_s, map_), view, at(right_px, down_px));
  }

  ViewBuilder builder_;
  std::int64_t now_ns_ = 0;
  std::vector<Association> matches_;
  LandmarkMap map_{LandmarkMapConfig{}};
};

TEST_F(KnownPartsTest, APartIsKnownByFourLandmarksOfEarlierVisits) {
  recognise(3, 100, 20, 10);
  EXPECT_FALSE(isKnownAt(110, 20));
  recognise(1, 100, 40, 10);
  EXPECT_TRUE(isKnownAt(110, 20));
  EXPECT_TRUE(isKnownAt(10, -50)) << "the same part, of 4 x 3";
  EXPECT_FALSE(isKnownAt(-10, 20)) << "another part";
  EXPECT_FALSE(isKnownAt(110, 70)) << "another part";
}

TEST_F(KnownPartsTest, AFifthOfThePartsFeaturesMustBeLandmarks) {
  recognise(4, 100, 20, 10);
  for (int i = 0; i < 16; ++i) builder_.addPixel(60 + i, 0, kNoTrack);
  EXPECT_TRUE(isKnownAt(110, 20));
  builder_.addPixel(80, 0, kNoTrack);
  EXPECT_FALSE(isKnownAt(110, 20));
}

TEST_F(KnownPartsTest, LandmarksOfThisVisitDoNotCount) {
  recognise(20, 100, 20, kMinAge_s - 0.1);
  EXPECT_FALSE(isKnownAt(100, 20));
}

TEST_F(KnownPartsTest, WhatIsNotInViewIsNotKnown) {
  recognise(8, 300, 0, 10);
  EXPECT_TRUE(isKnownAt(310, 0));
  EXPECT_FALSE(isKnownAt(500, 0));
  Eigen::Vector3d behind = -at(310, 0);
  EXPECT_FALSE(isSeenIn(ImageParts().set(), builder_.view(), behind));
}

}  // namespace
}  // namespace ardrone_vslam::test
