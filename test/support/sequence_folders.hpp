// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace ardrone_vslam {

/// A tiny picture; no two of the indices 0 to 11 give the same one.
inline cv::Mat testImage(int index, int width_px = 32, int height_px = 24) {
  cv::Mat image(height_px, width_px, CV_8UC1);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      image.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>((17 * x + 29 * y + 41 * index) & 0xff);
    }
  }
  return image;
}

inline void writeImages(const TemporaryFolder& folder, const std::string& sub, int count) {
  std::filesystem::create_directory(folder.file(sub));
  for (int i = 0; i < count; ++i) {
    char name[16];
    std::snprintf(name, sizeof(name), "/%06d.png", i % 1000000);
    cv::imwrite(folder.file(sub + name), testImage(i));
  }
}

inline std::string textTimes(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(0.1 * i) + "\n";
  return text;
}

/// `count` images at 10 Hz; the camera starts away from the origin of KITTI's world, turned by 90
/// degrees about its y axis (down), and moves 0.5 m a frame along the world's x (right).
inline void makeKittiFolder(const TemporaryFolder& folder, int count) {
  writeImages(folder, "image_0", count);
  folder.write("calib.txt", "P0: 20 0 16 0 0 21 12 0 0 0 1 0\nP1: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  folder.write("times.txt", textTimes(count));
  std::string poses;
  for (int i = 0; i < count; ++i) {
    poses += "0 0 1 " + std::to_string(3 + 0.5 * i) + " 0 1 0 -2 -1 0 0 7\n";
  }
  folder.write("poses.txt", poses);
}

inline std::string textCameraYaml(const std::string& model, const std::string& coefficients) {
  return "image_width: 32\nimage_height: 24\ncamera_name: test\n"
         "camera_matrix: {rows: 3, cols: 3, data: [20, 0, 16, 0, 21, 12, 0, 0, 1]}\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients: {rows: 1, cols: 5, data: [" + coefficients + "]}\n";
}

/// `count` images at 10 Hz; poses at 5 Hz, 1 m a second along the world's x axis, which the camera
/// looks along.
inline void makeTumFolder(const TemporaryFolder& folder, int count) {
  writeImages(folder, "image", count);
  folder.write("camera.yaml", textCameraYaml("plumb_bob", "-0.3, 0.1, 0.001, 0.002, 0.05"));
  folder.write("times.txt", textTimes(count));
  std::string poses = "# stamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < count; i += 2) {
    const std::string x = std::to_string(0.1 * i);
    poses += x + " " + x + " 2 3 0.5 -0.5 0.5 -0.5\n";
  }
  folder.write("poses_tum.txt", poses);
}

/// Expects an exception whose message has every one of `parts`.
inline void expectError(const std::function<void()>& action,
                        const std::vector<std::string>& parts) {
  std::string message;
  try {
    action();
  } catch (const std::exception& e) {
    message = e.what();
  }
  ASSERT_FALSE(message.empty()) << "no exception";
  for (const auto& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
  }
}

}  // namespace ardrone_vslam
