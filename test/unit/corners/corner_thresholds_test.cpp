// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_thresholds.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

/// One cell, a share of 10 corners.
class CornerThresholdsTest : public testing::Test {
 protected:
  CornerThresholdsTest() {
    config_.features_per_frame = 10;
    cells_.reset(100, 100, 100);
    thresholds_.reset(config_, 1);
  }

  /// Shows it an image that has `count` corners at the present threshold, their scores one apart,
  /// and returns the next threshold.
  int next(int count) {
    std::vector<Corner> corners;
    for (int i = 0; i < count; ++i) {
      corners.push_back(
          {static_cast<std::int16_t>(i), 5, static_cast<std::uint8_t>(thresholds_.at(0) + i)});
    }
    CornersByCell by_cell;
    by_cell.group(corners, cells_);
    thresholds_.adapt(by_cell);
    return thresholds_.at(0);
  }

  CornerDetectorConfig config_;
  CornerCells cells_;
  CornerThresholds thresholds_;
};

TEST_F(CornerThresholdsTest, StartsAtTheConfiguredOne) {
  EXPECT_EQ(thresholds_.at(0), 35);
}

TEST_F(CornerThresholdsTest, StaysInsideTheBand) {
  EXPECT_EQ(next(10), 35);
  EXPECT_EQ(next(20), 35);
}

TEST_F(CornerThresholdsTest, RisesAtOnceToOneAndAHalfShares) {
  // Of scores 35 .. 95 those from 81 on are 15.
  EXPECT_EQ(next(61), 81);
}

TEST_F(CornerThresholdsTest, FallsSlowlyWithTooFew) {
  EXPECT_EQ(next(9), 31);  // an eighth
  EXPECT_EQ(next(4), 24);  // a quarter
}

TEST_F(CornerThresholdsTest, StaysWithinItsLimits) {
  for (int i = 0; i < 40; ++i) next(0);
  EXPECT_EQ(thresholds_.at(0), config_.threshold_min);
  next(60);
  next(60);
  next(60);
  EXPECT_EQ(next(60), config_.threshold_max);
}

TEST_F(CornerThresholdsTest, ManyEqualCornersDoNotStarveTheCell) {
  std::vector<Corner> corners(50, Corner{5, 5, 35});
  CornersByCell by_cell;
  by_cell.group(corners, cells_);
  thresholds_.adapt(by_cell);
  EXPECT_EQ(thresholds_.at(0), 35);  // 36 would leave none
}

TEST_F(CornerThresholdsTest, NothingHappensWithoutAdaptation) {
  config_.adapt_threshold = false;
  thresholds_.reset(config_, 1);
  EXPECT_EQ(next(0), 35);
  EXPECT_EQ(next(60), 35);
}

}  // namespace
}  // namespace ardrone_vslam
