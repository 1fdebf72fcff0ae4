// SPDX-License-Identifier: BSD-3-Clause
#include "corners/corner_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/grey_images.hpp"

namespace ardrone_vslam {
namespace {

using test::fillDots;
using test::GreyImage;

constexpr int kWidth = 480;
constexpr int kHeight = 240;

/// About 1150 dots, each a corner with a score of 45 or more.
GreyImage textured(unsigned seed) {
  std::mt19937 random(seed);
  GreyImage image(kWidth, kHeight, 8);
  fillDots(image, {10, 100, 1, 127}, random, 0, kWidth);
  return image;
}

/// Bright texture on the left half, shaded on the right: a quarter of the brightness and of the
/// contrast.
GreyImage halfShaded(unsigned seed) {
  std::mt19937 random(seed);
  GreyImage image(kWidth, kHeight);
  fillDots(image, {10, 100, 1, 120}, random, 0, kWidth / 2);
  fillDots(image, {10, 25, 1, 30}, random, kWidth / 2, kWidth);
  return image;
}

std::vector<Corner> detect(CornerDetector& detector, const GreyImage& image) {
  std::vector<Corner> corners;
  detector.detect(image.view(), corners);
  return corners;
}

std::vector<int> asNumbers(const std::vector<Corner>& corners) {
  std::vector<int> numbers;
  for (const Corner& c : corners) numbers.insert(numbers.end(), {c.x_px, c.y_px, c.score});
  return numbers;
}

long rightHalf(const std::vector<Corner>& corners) {
  return std::count_if(corners.begin(), corners.end(),
                       [](const Corner& c) { return c.x_px >= kWidth / 2; });
}

int weakest(const std::vector<Corner>& corners) {
  int score = 255;
  for (const Corner& c : corners) score = std::min<int>(score, c.score);
  return score;
}

TEST(CornerDetectorConfig, ListsEveryFault) {
  CornerDetectorConfig config;
  config.features_per_frame = 0;
  config.cell_size_px = 8;
  config.threshold_min = 30;
  config.threshold_max = 20;
  try {
    const CornerDetector detector(config);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.faults().size(), 3U) << error.what();
    EXPECT_NE(error.faults()[0].find("features_per_frame is 0"), std::string::npos);
    EXPECT_NE(error.faults()[1].find("cell_size_px is 8"), std::string::npos);
    EXPECT_NE(error.faults()[2].find("threshold_min is 30 but threshold_max is only 20"),
              std::string::npos);
  }
}

TEST(CornerDetectorConfig, StartValueMustBeWithinTheLimitsOnlyIfItAdapts) {
  CornerDetectorConfig config;
  config.threshold = 5;
  EXPECT_THROW(CornerDetector{config}, ConfigError);
  config.threshold = 200;
  EXPECT_THROW(CornerDetector{config}, ConfigError);
  config.adapt_threshold = false;
  EXPECT_NO_THROW(CornerDetector{config});
}

TEST(CornerDetector, ImagesWithoutRoomForACircleHaveNoCorners) {
  CornerDetector detector({});
  std::vector<Corner> corners(3);
  detector.detect(ImageView{}, corners);
  EXPECT_TRUE(corners.empty());
  for (const int side : {1, 3, 6}) {
    EXPECT_TRUE(detect(detector, GreyImage(side, 50, 0, 9)).empty());
    EXPECT_TRUE(detect(detector, GreyImage(50, side, 0, 9)).empty());
  }
}

TEST(CornerDetector, SmallestImageWithACorner) {
  GreyImage image(7, 7, 4, 10);
  image.at(3, 3) = 110;
  CornerDetector detector({});
  EXPECT_EQ(asNumbers(detect(detector, image)), (std::vector<int>{3, 3, 99}));
}

TEST(CornerDetector, EmptyImagesChangeNothing) {
  CornerDetector with({});
  CornerDetector without({});
  for (unsigned seed = 1; seed < 6; ++seed) {
    std::vector<Corner> corners;
    with.detect(ImageView{}, corners);
    detect(with, GreyImage(5, 5));
    EXPECT_EQ(asNumbers(detect(with, textured(seed))), asNumbers(detect(without, textured(seed))));
  }
}

TEST(CornerDetector, RecoversFromBlackImagesWithinAFewFrames) {
  CornerDetectorConfig config;
  config.features_per_frame = 200;
  CornerDetector detector(config);
  std::vector<Corner> before;
  for (int i = 0; i < 5; ++i) before = detect(detector, textured(1));
  ASSERT_EQ(before.size(), 200U);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(detect(detector, GreyImage(kWidth, kHeight)).empty());
  std::vector<Corner> after;
  for (int i = 0; i < 3; ++i) after = detect(detector, textured(1));
  EXPECT_EQ(asNumbers(after), asNumbers(before));
}

TEST(CornerDetector, NewImageSizeStartsAfresh) {
  CornerDetector used({});
  for (int i = 0; i < 10; ++i) detect(used, GreyImage(100, 80));
  CornerDetector fresh({});
  const GreyImage image = halfShaded(3);
  EXPECT_EQ(asNumbers(detect(used, image)), asNumbers(detect(fresh, image)));
}

TEST(CornerDetector, KeepsTheBudgetRasterOrderAndBorder) {
  CornerDetectorConfig config;
  config.features_per_frame = 137;
  CornerDetector detector(config);
  const std::vector<Corner> corners = detect(detector, textured(5));
  ASSERT_EQ(corners.size(), 137U);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_GE(std::min(corners[i].x_px, corners[i].y_px), 3);
    EXPECT_LT(corners[i].x_px, kWidth - 3);
    EXPECT_LT(corners[i].y_px, kHeight - 3);
    if (i == 0) continue;
    const Corner& last = corners[i - 1];
    EXPECT_TRUE(last.y_px < corners[i].y_px ||
                (last.y_px == corners[i].y_px && last.x_px < corners[i].x_px));
  }
}

TEST(CornerDetector, ShadedHalfGetsItsShare) {
  CornerDetectorConfig config;
  config.features_per_frame = 180;
  CornerDetector adaptive(config);
  config.adapt_threshold = false;
  CornerDetector fixed(config);
  std::vector<Corner> corners;
  for (unsigned seed = 1; seed <= 15; ++seed) corners = detect(adaptive, halfShaded(seed));
  EXPECT_EQ(corners.size(), 180U);
  EXPECT_GE(rightHalf(corners), 75);
  EXPECT_LE(rightHalf(corners), 105);
  EXPECT_EQ(rightHalf(detect(fixed, halfShaded(15))), 0);
}

TEST(CornerDetector, EmptyPartsLeaveTheirShareToTheOthers) {
  CornerDetectorConfig config;
  config.features_per_frame = 180;
  CornerDetector detector(config);
  for (unsigned seed = 1; seed <= 15; ++seed) {
    std::mt19937 random(seed);
    GreyImage image(kWidth, kHeight, 0, 200);
    fillDots(image, {10, 100, 1, 127}, random, 0, kWidth / 3);  // two columns of cells out of six
    EXPECT_EQ(detect(detector, image).size(), 180U) << seed;
  }
}

TEST(CornerDetector, FixedThresholdIsExact) {
  CornerDetectorConfig config;
  config.adapt_threshold = false;
  config.features_per_frame = 20000;
  const GreyImage image = halfShaded(2);
  CornerDetector detector(config);
  const std::vector<int> first = asNumbers(detect(detector, image));
  EXPECT_FALSE(first.empty());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(asNumbers(detect(detector, image)), first);
  EXPECT_GE(weakest(detect(detector, image)), config.threshold);
}

TEST(CornerDetector, ThresholdsRiseUntilTheCountIsInTheBand) {
  // One cell, so that all corners above its threshold can be seen: a share of 60, a band up to 120.
  CornerDetectorConfig config;
  config.features_per_frame = 60;
  config.cell_size_px = 4096;
  CornerDetector detector(config);
  const GreyImage image = textured(9);
  detect(detector, image);
  const int at_60 = weakest(detect(detector, image));  // the 60th strongest corner

  config.features_per_frame = 20000;
  config.adapt_threshold = false;
  config.threshold = at_60;
  CornerDetector all(config);
  EXPECT_GE(detect(all, image).size(), 60U);
  EXPECT_LE(detect(all, image).size(), 120U);
}

TEST(CornerDetector, SameImagesGiveTheSameCorners) {
  CornerDetectorConfig config;
  config.features_per_frame = 150;
  config.sampling_passes = 6;
  CornerDetector a(config);
  CornerDetector b(config);
  for (unsigned seed = 1; seed < 12; ++seed) {
    EXPECT_EQ(asNumbers(detect(a, halfShaded(seed))), asNumbers(detect(b, halfShaded(seed))))
        << seed;
  }
}

}  // namespace
}  // namespace ardrone_vslam
