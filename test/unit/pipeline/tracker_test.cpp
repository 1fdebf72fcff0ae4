// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/tracker.hpp"

#include <gtest/gtest.h>

#include "support/generated_image.hpp"
#include "support/intrinsics.hpp"
#include "support/textured_image.hpp"

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

TEST(Tracker, TracksLieBetweenPixelsUnlessToldOtherwise) {
  const test::Texture texture(5);
  for (const bool align_tracks : {true, false}) {
    TrackerConfig config;
    config.align_tracks = align_tracks;
    Tracker tracker(config, test::pinhole(200, 160, 200));
    ImageFeatures features;
    tracker.process(texture.image(200, 160, 0, 0, 1.8).view(), 1, features);
    tracker.process(texture.image(200, 160, 1.4, 0.6, 1.8).view(), 2, features);
    int between = 0;
    for (const Eigen::Vector2f& pixel_px : features.pixel_px)
      between += pixel_px != pixel_px.array().round().matrix() ? 1 : 0;
    ASSERT_GT(features.size(), 10U);
    EXPECT_EQ(between > 5, align_tracks);
    EXPECT_EQ(features.information.size(), align_tracks ? features.size() : 0U);
    EXPECT_TRUE(align_tracks || between == 0);
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
