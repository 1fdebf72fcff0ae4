// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak_orientation.hpp"

#include <gtest/gtest.h>

#include <random>

namespace ardrone_vslam {
namespace {

bool agree(int x, int y) {
  return freakOrientation(x, y) == freakOrientation(freakAngle_deg(x, y));
}

TEST(FreakOrientation, FastAndExactIndexAgreeOnAllSmallSums) {
  for (int y = -400; y <= 400; ++y) {
    for (int x = -400; x <= 400; ++x) ASSERT_TRUE(agree(x, y)) << x << ", " << y;
  }
}

// Sums of 45 pairs stay below 10^4.
TEST(FreakOrientation, FastAndExactIndexAgreeOnRandomSums) {
  std::mt19937 random(1);
  for (int round = 0; round < 1000000; ++round) {
    const int x = static_cast<int>(random() % 40001) - 20000;
    const int y = static_cast<int>(random() % 40001) - 20000;
    ASSERT_TRUE(agree(x, y)) << x << ", " << y;
  }
}

TEST(FreakOrientation, AxesAndHalfTurn) {
  EXPECT_EQ(freakOrientation(0, 0), 0);
  EXPECT_EQ(freakOrientation(5, 0), 0);
  EXPECT_EQ(freakOrientation(0, 5), 64);
  EXPECT_EQ(freakOrientation(-5, 0), 128);
  EXPECT_EQ(freakOrientation(0, -5), 192);
  EXPECT_EQ(freakOrientation(7, 7), 32);
  EXPECT_EQ(freakAngle_deg(-5, 0), 180.F);
}

TEST(FreakOrientation, RadiansOfManyTurnsComeWithinHalfATurn) {
  EXPECT_NEAR(degreesWithinHalfTurn(0.5F), 28.6479F, 1e-4F);
  EXPECT_NEAR(degreesWithinHalfTurn(-0.5F - 4 * 3.14159265F), -28.6479F, 1e-3F);
  EXPECT_NEAR(degreesWithinHalfTurn(4.F), 4.F * 57.29578F - 360.F, 1e-3F);
}

}  // namespace
}  // namespace ardrone_vslam
