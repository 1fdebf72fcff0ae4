// SPDX-License-Identifier: BSD-3-Clause
#include "freak_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace ardrone_vslam {
namespace {

using kernels::FreakBox;
using kernels::kFreakFields;

bool isIrregular(const FreakPattern& pattern, int orientation, int index) {
  const auto& list = pattern.irregular(orientation);
  return std::any_of(list.begin(), list.end(),
                     [index](const auto& entry) { return entry.index == index; });
}

TEST(FreakPattern, RegularBoxesAreTheSameAtEveryCoordinateOfTheLargestImage) {
  const FreakPattern pattern;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    for (int index = 0; index < kFreakFields; ++index) {
      if (isIrregular(pattern, orientation, index)) continue;
      const FreakBox box = pattern.boxes(orientation)[index];
      const FreakField field = pattern.field(0, orientation, index);
      for (int c = 24; c < FreakPattern::kLargestSide_px - 23; ++c) {
        const FreakPixelBox exact = boxAround(field, c, c);
        const bool equal = exact.left_px - c == box.left && exact.right_px - c == box.right &&
                           exact.top_px - c == box.top && exact.bottom_px - c == box.bottom;
        ASSERT_TRUE(equal) << "orientation " << orientation << " field " << index << " at " << c;
      }
    }
  }
}

// Otherwise most of the work would be done twice; 72 boxes truly differ within images of moderate
// size.
TEST(FreakPattern, FewBoxesAreIrregularAndEightOfThemUnturned) {
  const FreakPattern pattern;
  std::size_t count = 0;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation)
    count += pattern.irregular(orientation).size();
  EXPECT_GE(count, 72U);
  EXPECT_LE(count, 200U) << "of 11008";
  EXPECT_EQ(pattern.irregular(0).size(), 8U);
}

// 16-bit sums, the table of reciprocals and the 8-bit offsets rest on these limits.
TEST(FreakPattern, BoxesFitTheirKernels) {
  const FreakPattern pattern;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    for (int index = 0; index < kernels::kFreakPaddedFields; ++index) {
      const FreakBox box = pattern.boxes(orientation)[index];
      const int area = (box.right - box.left) * (box.bottom - box.top);
      EXPECT_GE(area, 4);
      EXPECT_LE(area, 256);
      const FreakPixelBox exact =
          boxAround(pattern.field(0, orientation, std::min(index, kFreakFields - 1)), 24, 24);
      for (const int offset :
           {exact.left_px, exact.top_px, exact.right_px - 1, exact.bottom_px - 1}) {
        EXPECT_GE(offset, 0) << "a keypoint at the border must find its pixels";
        EXPECT_LT(offset, 48);
      }
    }
  }
}

TEST(FreakPattern, EveryScalesFieldsStayInsideItsBorder) {
  const FreakPattern pattern;
  int previous = 0;
  for (int scale = 0; scale < kFreakScales; ++scale) {
    const int border = pattern.border_px(scale);
    EXPECT_GE(border, previous);
    previous = border;
    for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
      for (int index = 0; index < kFreakFields; ++index) {
        const FreakPixelBox box =
            boxAround(pattern.field(scale, orientation, index), border + 1, border + 1);
        ASSERT_GE(std::min(box.left_px, box.top_px), 0);
        ASSERT_LE(std::max(box.right_px, box.bottom_px), 2 * border + 2);
      }
    }
  }
  EXPECT_EQ(pattern.border_px(0), 23);
}

TEST(FreakPattern, ScaleOfAKeypointsSize) {
  EXPECT_EQ(FreakPattern::scaleOf(7.F), 0);
  EXPECT_EQ(FreakPattern::scaleOf(14.F), 16) << "16 steps an octave";
  EXPECT_EQ(FreakPattern::scaleOf(28.F), 32);
  EXPECT_EQ(FreakPattern::scaleOf(0.F), 0);
  EXPECT_EQ(FreakPattern::scaleOf(-1.F), 0);
  EXPECT_EQ(FreakPattern::scaleOf(1e30F), 63);
}

TEST(FreakPattern, ComparisonsAreTheSelectedPairsEachOnce) {
  const FreakPattern pattern;
  std::set<std::array<int, 2>> pairs;
  for (int entry = 0; entry < kFreakBits; ++entry) {
    EXPECT_GT(pattern.first()[entry], pattern.second()[entry]);
    EXPECT_LT(pattern.first()[entry], kFreakFields);
    pairs.insert({pattern.first()[entry], pattern.second()[entry]});
  }
  EXPECT_EQ(pairs.size(), 512U);
}

// (sum + area / 2) / area for every area that occurs and every sum that it can have.
TEST(FreakKernels, MeanIsTheRoundedDivision) {
  for (int side = 2; side <= 16; ++side) {
    for (int other = side; other <= std::min(side + 1, 16); ++other) {
      const int area = side * other;
      std::vector<std::uint16_t> integral(static_cast<std::size_t>((side + 1) * (other + 1)));
      std::array<FreakBox, kernels::kFreakPaddedFields> boxes;
      boxes.fill({0, 0, static_cast<std::int8_t>(side), static_cast<std::int8_t>(other)});
      std::array<std::uint8_t, kernels::kFreakPaddedFields> means{};
      for (int sum = 0; sum <= 255 * area; ++sum) {
        integral.back() = static_cast<std::uint16_t>(sum);
        kernels::freakMeansScalar(integral.data(), side + 1, boxes.data(), means.data());
        ASSERT_EQ(means[0], (sum + area / 2) / area) << sum << " over " << area;
      }
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam
