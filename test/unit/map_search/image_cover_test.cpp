// SPDX-License-Identifier: BSD-3-Clause
#include "map_search/image_cover.hpp"

#include <gtest/gtest.h>

#include "support/view_builder.hpp"

namespace ardrone_vslam::test {
namespace {

constexpr double kDepth_m = 4;
constexpr int kColumns = 4;  // of the grid
constexpr int kRows = 3;
constexpr double kCell_px = 640.0 / kColumns;

class ImageCoverTest : public ::testing::Test {
 protected:
  ImageCoverTest() {
    builder_.lookFrom({0, 0, 0});
    builder_.addFrame();
  }

  /// So many landmarks in the middle of a cell, of which the first `seen` are features, too.
  void fill(int column, int row, int landmarks, int seen) {
    for (int i = 0; i < landmarks; ++i) {
      const double right_px = (column + 0.5) * kCell_px - 320 + 10 * i - 25;
      const double down_px = (row + 0.5) * 360 / kRows - 180;
      Landmark landmark;
      landmark.position_map << kDepth_m, -right_px / kPointFocalLength_px * kDepth_m,
          -down_px / kPointFocalLength_px * kDepth_m;
      landmark.view_direction_map = landmark.position_map.normalized().cast<float>();
      const Descriptor descriptor = builder_.randomDescriptor();
      landmark.descriptor = descriptor;
      map_.add(landmark);
      if (i < seen) builder_.addPixel(right_px, down_px, kNoTrack, descriptor);
    }
  }
  double cover() { return ImageCover(AssociationConfig{}).of(builder_.view(), map_); }

  ViewBuilder builder_;
  LandmarkMap map_{LandmarkMapConfig{}};
};

TEST_F(ImageCoverTest, IsTheShareOfTheCellsThatAreRecognised) {
  for (int column = 0; column < kColumns; ++column) {
    for (int row = 0; row < kRows; ++row) fill(column, row, 6, column == 1 ? 6 : 0);
  }
  EXPECT_DOUBLE_EQ(cover(), 1.0 / kColumns);
}

TEST_F(ImageCoverTest, OneLandmarkOfSixRecognisesACellFewOfManyDoNot) {
  fill(0, 0, 6, 1);
  for (int i = 0; i < 4; ++i) fill(2, 2, 6, i == 0 ? 1 : 0);
  EXPECT_DOUBLE_EQ(cover(), 0.5);
}

TEST_F(ImageCoverTest, CellsThatShouldShowFewLandmarksDoNotCount) {
  fill(0, 0, 6, 6);
  fill(3, 1, 3, 0);
  EXPECT_DOUBLE_EQ(cover(), 1);
}

TEST_F(ImageCoverTest, IsZeroWhereNothingShouldBeSeen) {
  EXPECT_DOUBLE_EQ(cover(), 0);
}

}  // namespace
}  // namespace ardrone_vslam::test
