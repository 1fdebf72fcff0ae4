// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/generated_image.hpp"

namespace ardrone_vslam {
namespace {

CameraIntrinsics camera(int width_px, int height_px) {
  CameraIntrinsics intrinsics;
  intrinsics.width_px = width_px;
  intrinsics.height_px = height_px;
  intrinsics.fx_px = intrinsics.fy_px = width_px;
  intrinsics.cx_px = 0.5 * width_px - 0.5;
  intrinsics.cy_px = 0.5 * height_px - 0.5;
  return intrinsics;
}

ImageFeatures featuresOf(const test::TestImage& image, int budget) {
  TrackerConfig config;
  config.corners.features_per_frame = budget;
  config.corners.threshold = config.corners.threshold_min;
  Tracker tracker(config, camera(image.width_px, image.height_px));
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

TEST(Tracker, CornersOnEdgesAreLeftOut) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> noise(0, 3);
  test::TestImage image(200, 120);
  const auto below_step_px = [](int x, int y) { return y - (40 + x / 9.0); };
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double share = std::min(std::max(below_step_px(x, y) + 0.5, 0.0), 1.0);
      const bool is_in_square = x >= 60 && x < 80 && y >= 80 && y < 90;
      // Noise makes corners of an edge.
      const double grey =
          std::abs(below_step_px(x, y)) < 2 ? 40 + 80 * share + noise(engine) : 40 + 80 * share;
      image.at(x, y) = static_cast<std::uint8_t>(is_in_square ? 230 : std::lround(grey));
    }
  }
  TrackerConfig config;
  config.corners.arc_length_px = 9;
  config.corners.adapt_threshold = false;
  config.corners.threshold = 5;
  const auto cornersOnStep = [&](double edge_ratio) {
    config.edge_ratio = edge_ratio;
    Tracker tracker(config, camera(image.width_px, image.height_px));
    ImageFeatures features;
    tracker.process(image.view(), 1, features);
    std::size_t count = 0;
    for (const Eigen::Vector2f& at : features.pixel_px)
      count += std::abs(below_step_px(static_cast<int>(at.x()), static_cast<int>(at.y()))) < 4;
    EXPECT_EQ(features.size() - count, 4U) << "the square's";
    return count;
  };
  EXPECT_GT(cornersOnStep(0), 5U);
  EXPECT_EQ(cornersOnStep(0.1), 0U);
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
