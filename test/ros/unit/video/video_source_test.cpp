// SPDX-License-Identifier: BSD-3-Clause
#include "video/video_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "support/contains.hpp"
#include "support/temporary_folder.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kFrames = 5;

/// JPEG images one after the other, which is a video without a rate of its own.
std::string writeVideo(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  for (int i = 0; i < kFrames; ++i) {
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i + 20)), jpeg);
    file.write(reinterpret_cast<const char*>(jpeg.data()),
               static_cast<std::streamsize>(jpeg.size()));
  }
  return path;
}

std::string refusalOf(const std::string& device) {
  try {
    VideoSource(device, {}, 30);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

using test::contains;

TEST(VideoSource, AFileComesImageByImageAtItsRateAndEnds) {
  ros::Time::init();
  const TemporaryFolder folder;
  VideoSource source(writeVideo(folder.file("video.mjpg")), {}, 20);
  EXPECT_TRUE(source.isFile());
  cv::Mat image;
  ros::Time stamp;
  ros::Time before;
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(source.read(image, stamp)) << i;
    EXPECT_EQ(image.size(), cv::Size(64, 48));
    EXPECT_NEAR(cv::mean(image)[0], 40 * i + 20, 2) << i;
    EXPECT_GE(ros::Time::now(), stamp) << "an image before its time";
    if (i > 0) {
      // The rate that was asked for, or 25 Hz: newer FFmpeg calls such a file's rate so.
      const double rate_hz = 1 / (stamp - before).toSec();
      EXPECT_LT(std::min(std::abs(rate_hz - 20), std::abs(rate_hz - 25)), 1e-3) << rate_hz;
    }
    before = stamp;
  }
  EXPECT_FALSE(source.read(image, stamp));
}

TEST(VideoSource, WhatIsNoVideoIsRefusedWithAdvice) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(refusalOf("/none/video.avi"), "'/none/video.avi': is not there"));
  EXPECT_TRUE(contains(refusalOf("/none/video.avi"), "ls /dev/video*"));
  EXPECT_TRUE(contains(refusalOf("97"), "/dev/video97"));
  EXPECT_TRUE(contains(refusalOf(folder.path()), "is no camera that can be opened"));
  EXPECT_TRUE(contains(refusalOf("/dev/null"), "is no camera that can be opened"));
  folder.write("text.avi", "no video");
  EXPECT_TRUE(contains(refusalOf(folder.file("text.avi")), "no video that OpenCV can read"));
}

TEST(VideoSource, TheDriversTimeIsTakenWhereItIsOne) {
  EXPECT_EQ(ageOfImage_ns(5000.0, 5020.5), 20'500'000);
  EXPECT_EQ(ageOfImage_ns(0, 5000), 0) << "none";
  EXPECT_EQ(ageOfImage_ns(5001, 5000), 0) << "after now";
  EXPECT_EQ(ageOfImage_ns(1000, 5000), 0) << "of another clock";
}

}  // namespace
}  // namespace ardrone_vslam
