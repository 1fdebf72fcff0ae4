// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "corners/corner_detector.hpp"
#include "support/grey_images.hpp"
#include "support/real_data.hpp"

// FAST-9 with strict suppression against OpenCV's: the same corners in the same order with the same
// scores.
namespace ardrone_vslam::test {
namespace {

constexpr int kManyCorners = 20000;

cv::Mat asMat(const ImageView& image) {
  return {image.height_px, image.width_px, CV_8UC1, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride_bytes)};
}

/// @return the number of corners that were compared
std::size_t expectEqualToOpenCv(const ImageView& image, int threshold, InstructionSet set) {
  CornerDetectorConfig config;
  config.arc_length_px = 9;
  config.threshold = threshold;
  config.adapt_threshold = false;
  config.suppression = Suppression::kStrict3x3;
  config.features_per_frame = kManyCorners;
  std::vector<Corner> corners;
  CornerDetector(config, set).detect(image, corners);

  std::vector<cv::KeyPoint> expected;
  cv::FAST(asMat(image), expected, threshold, true, cv::FastFeatureDetector::TYPE_9_16);
  EXPECT_LT(expected.size(), static_cast<std::size_t>(kManyCorners))
      << "the budget would cut this comparison";
  EXPECT_EQ(corners.size(), expected.size());
  for (std::size_t i = 0; i < std::min(corners.size(), expected.size()); ++i) {
    const bool equal = static_cast<float>(corners[i].x_px) == expected[i].pt.x &&
                       static_cast<float>(corners[i].y_px) == expected[i].pt.y &&
                       static_cast<float>(corners[i].score) == expected[i].response;
    if (equal) continue;
    ADD_FAILURE() << "corner " << i << ": " << corners[i].x_px << ", " << corners[i].y_px
                  << " score " << int{corners[i].score} << ", OpenCV " << expected[i].pt << " "
                  << expected[i].response;
    break;
  }
  return expected.size();
}

class FastAgainstOpenCv : public testing::TestWithParam<InstructionSet> {};

TEST_P(FastAgainstOpenCv, RandomImages) {
  std::size_t compared = 0;
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const GreyImage& image : variedImages(seed)) {
      for (const int threshold : {1, 8, 35, 90})
        compared += expectEqualToOpenCv(image.view(), threshold, GetParam());
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST_P(FastAgainstOpenCv, KittiFrames) {
  if (realData().empty())
    GTEST_SKIP() << "set ARDRONE_VSLAM_DATA to the folder of real data to run this";
  std::size_t compared = 0;
  for (const char* name : {"000000", "000070", "000300"}) {
    const std::string file = realData() + "/kitti_03/image_0/" + name + ".png";
    const cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(image.empty()) << "cannot read " << file;
    const ImageView view{image.data, image.cols, image.rows,
                         static_cast<std::ptrdiff_t>(image.step)};
    for (const int threshold : {10, 20, 35})
      compared += expectEqualToOpenCv(view, threshold, GetParam());
  }
  EXPECT_GT(compared, 1000U);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, FastAgainstOpenCv,
                         testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& set) { return std::string(nameOf(set.param)); });

}  // namespace
}  // namespace ardrone_vslam::test
