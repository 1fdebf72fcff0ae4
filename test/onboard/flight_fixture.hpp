// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdio>
#include <string>
#include <vector>

#include "onboard/flight_records.hpp"
#include "settings/settings.hpp"

namespace ardrone_vslam::test {

inline constexpr std::int64_t kFirst_ns = 1'000'000'000;
inline constexpr std::int64_t kPeriod_ns = 50'000'000;
inline constexpr int kImages = 4;

/// What OnboardLoop reads: a camera at rest before a generated picture.
class FlightFixture : public ::testing::Test {
 protected:
  FlightFixture() {
    folder_ = ::testing::TempDir() + "onboard_flight_XXXXXX";
    EXPECT_NE(::mkdtemp(folder_.data()), nullptr);
    writeFile(
        file("camera.yaml"),
        "image_width: 160\nimage_height: 120\ncamera_matrix:\n  data: [150, 0, 80, 0, 150, 60, "
        "0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  data: []\n");
    std::string stream;
    for (int i = 0; i < kImages; ++i) stream += pgm(stampOf(i), image_);
    writeFile(file("frames"), stream);
    settings_.onboard.camera = file("camera.yaml");
    settings_.onboard.frames = file("frames");
    settings_.onboard.poses = file("poses");
    settings_.onboard.pose_address = "";
    settings_.onboard.observer = "127.0.0.1:0";  // any port
    settings_.onboard.cpu_share = 1;
    settings_.odometry_wait_s = 0.01;
  }
  ~FlightFixture() override {
    for (const char* name : {"camera.yaml", "frames", "poses", "observer", "map"})
      std::remove(file(name).c_str());
    ::rmdir(folder_.c_str());
  }

  static std::int64_t stampOf(int image) { return kFirst_ns + image * kPeriod_ns; }
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::vector<VslamPose> poses() const { return posesIn(file("poses")); }

  /// States from before the first image to after the last.
  static std::string records() {
    std::string bytes;
    for (int i = -1; i <= kImages; ++i) {
      VslamObserver observer = odometryAt(stampOf(i), static_cast<std::uint32_t>(i + 10));
      observer.position_m[0] = 0.5;
      const Record record = recordOf(observer);
      bytes.append(record.begin(), record.end());
    }
    return bytes;
  }

  std::string folder_;
  TestImage image_ = generatedImage(160, 120);
  Settings settings_;
  Pipe stop_;
};

}  // namespace ardrone_vslam::test
