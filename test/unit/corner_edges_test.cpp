// SPDX-License-Identifier: BSD-3-Clause
#include "corner_edges.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "support/generated_image.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kSide_px = 31;
constexpr int kMiddle_px = 15;

std::uint8_t grey(double value) {
  return static_cast<std::uint8_t>(std::lround(std::min(std::max(value, 0.0), 255.0)));
}

/// One pixel wide transition from dark to bright through the middle, and sensor noise.
test::TestImage edgeImage(double angle_rad, double noise, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0, noise);
  test::TestImage image(kSide_px, kSide_px);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const double across_px =
          (x - kMiddle_px) * std::cos(angle_rad) + (y - kMiddle_px) * std::sin(angle_rad);
      const double share = std::min(std::max(across_px + 0.5, 0.0), 1.0);
      image.at(x, y) = grey(80 + 90 * share + normal(engine));
    }
  }
  return image;
}

/// Whatever the direction: the angle between its two edges.
test::TestImage cornerImage(double angle_rad, double opening_rad) {
  test::TestImage image(kSide_px, kSide_px);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const double direction_rad =
          std::remainder(std::atan2(y - kMiddle_px, x - kMiddle_px) - angle_rad, 2 * M_PI);
      image.at(x, y) = std::abs(direction_rad) <= opening_rad / 2 ? 200 : 60;
    }
  }
  return image;
}

TEST(CornerEdges, AnEdgeIsOneInEveryDirection) {
  for (int degrees = 0; degrees < 180; degrees += 7) {
    const test::TestImage image = edgeImage(degrees * M_PI / 180, 4, 1);
    EXPECT_TRUE(liesOnEdge(image.view(), kMiddle_px, kMiddle_px, 0.1)) << degrees;
    EXPECT_FALSE(liesOnEdge(image.view(), kMiddle_px, kMiddle_px, 0)) << degrees;
  }
}

TEST(CornerEdges, ACornerIsNone) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    for (const double opening_deg : {60, 90, 120}) {
      const test::TestImage image = cornerImage(degrees * M_PI / 180, opening_deg * M_PI / 180);
      EXPECT_FALSE(liesOnEdge(image.view(), kMiddle_px, kMiddle_px, 0.1))
          << degrees << ' ' << opening_deg;
    }
  }
}

TEST(CornerEdges, AFlatPatchIsNone) {
  EXPECT_FALSE(liesOnEdge(test::TestImage(kSide_px, kSide_px).view(), kMiddle_px, kMiddle_px, 1));
}

/// Oracle: the eigenvalues themselves.
TEST(CornerEdges, TheRatioIsThatOfTheEigenvalues) {
  const test::TestImage image = test::generatedImage(160, 120);
  const auto at = [&image](int x, int y) { return static_cast<double>(image.view().at(x, y)); };
  int edges = 0;
  for (int y = kEdgeBorder_px; y < 120 - kEdgeBorder_px; y += 3) {
    for (int x = kEdgeBorder_px; x < 160 - kEdgeBorder_px; x += 3) {
      Eigen::Matrix2d tensor = Eigen::Matrix2d::Zero();
      for (int v = y - 3; v <= y + 3; ++v) {
        for (int u = x - 3; u <= x + 3; ++u) {
          const Eigen::Vector2d gradient(at(u + 1, v) - at(u - 1, v), at(u, v + 1) - at(u, v - 1));
          tensor += gradient * gradient.transpose();
        }
      }
      const Eigen::Vector2d eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(tensor).eigenvalues();
      if (eigenvalues[1] == 0) continue;
      const double ratio = eigenvalues[0] / eigenvalues[1];
      if (std::abs(ratio - 0.3) < 1e-6) continue;
      EXPECT_EQ(liesOnEdge(image.view(), x, y, 0.3), ratio < 0.3) << x << ' ' << y;
      edges += ratio < 0.3;
    }
  }
  EXPECT_GT(edges, 50);
}

}  // namespace
}  // namespace ardrone_vslam
