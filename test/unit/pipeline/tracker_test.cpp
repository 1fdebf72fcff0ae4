// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/tracker.hpp"

#include <gtest/gtest.h>

#include "support/generated_image.hpp"
#include "support/intrinsics.hpp"

namespace ardrone_vslam {
namespace {

ImageFeatures featuresOf(const test::TestImage& image, int budget) {
  TrackerConfig config;
  config.corners.features_per_frame = budget;
  config.corners.threshold = config.corners.threshold_min;
  Tracker tracker(config, test::pinhole(image.width_px, image.height_px, image.width_px));
  ImageFeatures features;
  tracker.process(image.view(), 1, features);
  return features;
}

TEST(Tracker, TheWholeBudgetIsDescribedWhereCornersAbound) {
  const test::TestImage image = test::generatedImage(320, 240);  // also along the border
  EXPECT_EQ(featuresOf(image, 150).size(), 150U);
}

TEST(Tracker, FeaturesLieWhereTheImageShowsTheirCorners) {
  test::TestImage image(100, 90);  // one bright pixel
  image.at(50, 40) = 255;
  const ImageFeatures features = featuresOf(image, 150);
  ASSERT_EQ(features.size(), 1U);
  EXPECT_EQ(features.pixel_px[0], Eigen::Vector2f(50, 40));
  // The first and the last pixel that can be tested and described.
  for (const auto& [x, y] : {std::pair{24, 24}, std::pair{75, 65}}) {
    image = test::TestImage(100, 90);
    image.at(x, y) = 255;
    EXPECT_EQ(featuresOf(image, 150).size(), 1U) << x;
  }
  for (const auto& [x, y] : {std::pair{23, 24}, std::pair{75, 66}}) {
    image = test::TestImage(100, 90);
    image.at(x, y) = 255;
    EXPECT_EQ(featuresOf(image, 150).size(), 0U) << x;
  }
}

TEST(Tracker, ImagesTooSmallForThePatternHaveNoFeatures) {
  for (const int size_px : {1, 7, 42, 43, 48}) {
    const test::TestImage image = test::generatedImage(size_px, size_px);
    EXPECT_EQ(featuresOf(image, 150).size(), 0U) << size_px;
  }
  EXPECT_GT(featuresOf(test::generatedImage(70, 70), 150).size(), 0U);
}

}  // namespace
}  // namespace ardrone_vslam
