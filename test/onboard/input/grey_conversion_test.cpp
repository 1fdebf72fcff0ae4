// SPDX-License-Identifier: BSD-3-Clause
#include "input/grey_conversion.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ardrone_vslam::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(GreyConversion, TakesTheLuminanceOfUyvy) {
  const Bytes pixels{1, 10, 2,  20, 3,  30, 4,  40, /* beyond the row */ 9,
                     9, 5,  50, 6,  60, 7,  70, 8,  80};
  Bytes grey(8);
  toGrey(PixelFormat::kUyvy, pixels.data(), 10, 4, 2, false, grey.data());
  EXPECT_EQ(grey, (Bytes{10, 20, 30, 40, 50, 60, 70, 80}));
}

TEST(GreyConversion, HalvingIsTheMeanWithAHalfRoundedUp) {
  const Bytes pixels{0, 1, 255, 255,  //
                     0, 1, 255, 254};
  Bytes grey(2);
  toGrey(PixelFormat::kGrey, pixels.data(), 4, 4, 2, true, grey.data());
  EXPECT_EQ(grey, (Bytes{1, 255}));
}

TEST(GreyConversion, TheFrontCameraHalvedIsThatOfItsLuminance) {
  constexpr int kWidth = 1280;
  constexpr int kHeight = 720;
  std::mt19937 random(1);
  Bytes uyvy(std::size_t{2} * kWidth * kHeight);
  for (auto& byte : uyvy) byte = static_cast<std::uint8_t>(random());
  Bytes grey(std::size_t{kWidth} * kHeight);
  toGrey(PixelFormat::kUyvy, uyvy.data(), 2 * kWidth, kWidth, kHeight, false, grey.data());
  Bytes halved(grey.size() / 4);
  toGrey(PixelFormat::kUyvy, uyvy.data(), 2 * kWidth, kWidth, kHeight, true, halved.data());
  for (std::size_t y = 0; y < kHeight / 2; ++y) {
    for (std::size_t x = 0; x < kWidth / 2; ++x) {
      const std::uint8_t* corner = &grey[2 * y * kWidth + 2 * x];
      const int sum = corner[0] + corner[1] + corner[kWidth] + corner[kWidth + 1];
      ASSERT_EQ(halved[y * kWidth / 2 + x], (sum + 2) / 4) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
