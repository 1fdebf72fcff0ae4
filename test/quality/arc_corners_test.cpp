// SPDX-License-Identifier: BSD-3-Clause
#include "arc_corners.hpp"

#include <gtest/gtest.h>

#include "support/fast_oracle.hpp"

namespace ardrone_vslam::reproduction {
namespace {

using test::GreyImage;
using test::Positions;
using test::ScoreOracle;

cv::Mat matOf(const GreyImage& image) {
  const ImageView view = image.view();
  cv::Mat mat(view.height_px, view.width_px, CV_8UC1);
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 0; x < view.width_px; ++x)
      mat.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(image.at(x, y));
  return mat;
}

TEST(ArcCorners, AreThoseOfTheDefinitionForEveryArc) {
  std::mt19937 random(3);
  constexpr int kThreshold = 12;
  int corners_of_16 = 0;
  for (int round = 0; round < 4; ++round) {
    GreyImage image(47, 35);
    const test::BlockTexture texture{round + 1, round < 2 ? 256 : 6, 255, 8};
    test::fillBlocks(image, texture, random, 0, image.width());
    for (int s = 9; s <= 16; ++s) {
      const ScoreOracle oracle(image, s);
      const Positions hits = oracle.corners(kThreshold);
      EXPECT_EQ(countArcCorners(matOf(image), s, kThreshold), static_cast<int>(hits.size())) << s;
      Positions found;
      for (const Corner& corner : arcCorners(matOf(image), s, kThreshold)) {
        found.insert({corner.y_px, corner.x_px});
        EXPECT_EQ(corner.score, oracle.at({corner.y_px, corner.x_px}));
      }
      EXPECT_EQ(found, oracle.strictMaxima(hits)) << s;
      if (s == 16) corners_of_16 += static_cast<int>(found.size());
    }
  }
  EXPECT_GT(corners_of_16, 0) << "or nothing was tested";
}

}  // namespace
}  // namespace ardrone_vslam::reproduction
