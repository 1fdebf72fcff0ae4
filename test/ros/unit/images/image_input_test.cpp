// SPDX-License-Identifier: BSD-3-Clause
#include "images/image_input.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>

#include "outputs/debug_image.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::uint32_t kWidth = 24;
constexpr std::uint32_t kHeight = 16;

/// An image of one colour, whose bytes repeat.
sensor_msgs::ImageConstPtr imageOf(const std::string& encoding,
                                   const std::vector<std::uint8_t>& pixel) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->width = kWidth;
  image->height = kHeight;
  image->encoding = encoding;
  image->step = kWidth * static_cast<std::uint32_t>(pixel.size());
  for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
    image->data.insert(image->data.end(), pixel.begin(), pixel.end());
  }
  return image;
}

TEST(ImageInput, MonoIsNotCopied) {
  for (const auto* encoding : {"mono8", "8UC1"}) {
    const auto message = imageOf(encoding, {77});
    const GreyImage grey = toGrey(message);
    EXPECT_EQ(grey.fault, "") << encoding;
    EXPECT_EQ(grey.view().data, message->data.data());
    EXPECT_EQ(grey.view().at(3, 5), 77);
    EXPECT_EQ(grey.view().width_px, static_cast<int>(kWidth));
  }
}

TEST(ImageInput, PaddedRows) {
  auto message = boost::make_shared<sensor_msgs::Image>(*imageOf("mono8", {0}));
  message->step = kWidth + 8;
  message->data.assign(message->step * kHeight, 0);
  message->data[message->step * 2 + 3] = 200;
  const GreyImage grey = toGrey(sensor_msgs::ImageConstPtr(message));
  ASSERT_EQ(grey.fault, "");
  EXPECT_EQ(grey.view().at(3, 2), 200);
}

TEST(ImageInput, ColoursBecomeTheirLuminance) {
  const int red_grey = 76;  // 0.299 * 255
  const std::vector<std::pair<std::string, std::vector<std::uint8_t>>> reds{
      {"rgb8", {255, 0, 0}},
      {"bgr8", {0, 0, 255}},
      {"rgba8", {255, 0, 0, 9}},
      {"bgra8", {0, 0, 255, 9}}};
  for (const auto& [encoding, pixel] : reds) {
    const GreyImage grey = toGrey(imageOf(encoding, pixel));
    ASSERT_EQ(grey.fault, "") << encoding;
    EXPECT_NEAR(grey.view().at(10, 10), red_grey, 1) << encoding;
  }
}

TEST(ImageInput, BayerOfAGreyScene) {
  for (const auto* encoding : {"bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"}) {
    const GreyImage grey = toGrey(imageOf(encoding, {120}));
    ASSERT_EQ(grey.fault, "") << encoding;
    EXPECT_NEAR(grey.view().at(10, 8), 120, 1) << encoding;
  }
}

TEST(ImageInput, SixteenBitsAreScaled) {
  const GreyImage grey = toGrey(imageOf("mono16", {0x00, 0x80}));  // little endian 32768
  ASSERT_EQ(grey.fault, "");
  EXPECT_NEAR(grey.view().at(10, 10), 128, 1);
}

TEST(ImageInput, FaultsAreNamed) {
  const auto fault = [](auto change) {
    auto message = boost::make_shared<sensor_msgs::Image>(*imageOf("mono8", {1}));
    change(*message);
    const GreyImage grey = toGrey(sensor_msgs::ImageConstPtr(message));
    EXPECT_TRUE(grey.pixels.empty());
    return grey.fault;
  };
  EXPECT_NE(fault([](auto& m) { m.encoding = "foo8"; }).find("foo8"), std::string::npos);
  EXPECT_NE(fault([](auto& m) { m.encoding = "32FC1"; }).find("32FC1"), std::string::npos);
  EXPECT_NE(fault([](auto& m) { m.data.resize(10); }).find("cannot be read"), std::string::npos);
  EXPECT_NE(fault([](auto& m) { m.step = 3; }).find("cannot be read"), std::string::npos);
  EXPECT_NE(fault([](auto& m) { m.width = 0; }).find("empty"), std::string::npos);
}

TEST(ImageInput, Compressed) {
  const cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(90));
  for (const auto* extension : {".png", ".jpg"}) {
    auto message = boost::make_shared<sensor_msgs::CompressedImage>();
    cv::imencode(extension, image, message->data);
    const GreyImage grey = toGrey(sensor_msgs::CompressedImageConstPtr(message));
    ASSERT_EQ(grey.fault, "") << extension;
    EXPECT_NEAR(grey.view().at(10, 10), 90, 2) << extension;
  }
}

TEST(ImageInput, CompressedFaultsAreNamed) {
  auto message = boost::make_shared<sensor_msgs::CompressedImage>();
  message->format = "jpeg";
  for (const std::size_t size : {0U, 100U}) {
    message->data.assign(size, 7);
    const GreyImage grey = toGrey(sensor_msgs::CompressedImageConstPtr(message));
    EXPECT_TRUE(grey.pixels.empty());
    EXPECT_NE(grey.fault.find(std::to_string(size) + " bytes"), std::string::npos) << grey.fault;
  }
}

TEST(ImageInput, HalfACompressedImageIsRefused) {
  for (const auto* extension : {".png", ".jpg"}) {
    auto message = boost::make_shared<sensor_msgs::CompressedImage>();
    cv::imencode(extension, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(90)), message->data);
    message->data.resize(message->data.size() - 20);
    const GreyImage grey = toGrey(sensor_msgs::CompressedImageConstPtr(message));
    EXPECT_TRUE(grey.pixels.empty()) << extension;
    EXPECT_NE(grey.fault.find("cannot be decoded (cut off before its end)"), std::string::npos)
        << grey.fault;
  }
}

TEST(DebugImage, CirclesTellTheAge) {
  const cv::Mat grey(40, 60, CV_8UC1, cv::Scalar(50));
  ImageFeatures features;
  features.pixel_px = {{15, 20}, {45, 20}};
  features.age_frames = {0, 30};
  const cv::Mat drawn = drawFeatures(grey, features);
  ASSERT_EQ(drawn.size(), grey.size());
  const auto new_one = drawn.at<cv::Vec3b>(20, 18);  // on the circle of radius 3
  const auto old_one = drawn.at<cv::Vec3b>(20, 48);
  EXPECT_GT(new_one[0], new_one[2]);  // blue
  EXPECT_GT(old_one[2], old_one[0]);  // red
  EXPECT_EQ(drawn.at<cv::Vec3b>(5, 30), cv::Vec3b(50, 50, 50));
}

}  // namespace
}  // namespace ardrone_vslam
