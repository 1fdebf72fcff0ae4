// SPDX-License-Identifier: BSD-3-Clause
#include "freak/freak_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "freak/freak.hpp"
#include "freak/freak_selected_pairs.hpp"

namespace ardrone_vslam {
namespace {

using kernels::FreakBox;
using kernels::kFreakFields;

bool isIrregular(const FreakPattern& pattern, int orientation, int index) {
  const auto& list = pattern.irregular(orientation);
  return std::any_of(list.begin(), list.end(),
                     [index](const auto& entry) { return entry.index == index; });
}

TEST(FreakPattern, BoxesHoldAtEveryCoordinateOfTheLargestImageButForTheExceptions) {
  const FreakPattern pattern;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    for (int index = 0; index < kFreakFields; ++index) {
      const bool irregular = isIrregular(pattern, orientation, index);
      const FreakField field = pattern.field(0, orientation, index);
      for (int c = 24; c < FreakPattern::kLargestSide_px - 23; ++c) {
        for (const int y : {c, c ^ 1}) {
          if (y > FreakPattern::kLargestSide_px - 24) continue;
          if (irregular && pattern.isExceptional(c, y)) continue;
          const FreakBox box = pattern.boxes(orientation, c, y)[index];
          const FreakPixelBox exact = boxAround(field, c, y);
          const bool equal = exact.left_px - c == box.left && exact.right_px - c == box.right &&
                             exact.top_px - y == box.top && exact.bottom_px - y == box.bottom;
          ASSERT_TRUE(equal) << "orientation " << orientation << " field " << index << " at " << c
                             << ", " << y;
        }
      }
    }
  }
}

// They are recomputed at exceptional coordinates; 48 boxes depend on whether the coordinates are
// even.
TEST(FreakPattern, FewBoxesAreIrregularAndOneOfThemUnturned) {
  const FreakPattern pattern;
  std::size_t count = 0;
  std::set<const FreakBox*> rows;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    count += pattern.irregular(orientation).size();
    for (int evenness = 0; evenness < 4; ++evenness)
      rows.insert(pattern.boxes(orientation, evenness % 2, evenness / 2));
  }
  EXPECT_EQ(count, 20U) << "of 11008";
  EXPECT_EQ(pattern.irregular(0).size(), 1U);
  int exceptional = 0;
  for (int c = 0; c < 2000; ++c) exceptional += pattern.isExceptional(c, c) ? 1 : 0;
  EXPECT_LE(exceptional, 40) << "of the first 2000 coordinates";
  EXPECT_LE(rows.size(), 300U) << "the table would outgrow the cache";
}

// 16-bit sums, the table of reciprocals and the 8-bit offsets rest on these limits.
TEST(FreakPattern, BoxesFitTheirKernels) {
  const FreakPattern pattern;
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    for (int index = 0; index < kernels::kFreakPaddedFields; ++index) {
      const FreakBox box = pattern.boxes(orientation, 24, 24)[index];
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
  EXPECT_EQ(kFreakBorder_px, pattern.border_px(0) + 1) << "where the tracker looks for corners";
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
  const kernels::FreakComparisons& lists = pattern.comparisons();
  for (int entry = 0; entry < kFreakBits; ++entry) {
    EXPECT_GT(lists.first.index[entry], lists.second.index[entry]);
    EXPECT_LT(lists.first.index[entry], kFreakFields);
    pairs.insert({lists.first.index[entry], lists.second.index[entry]});
  }
  EXPECT_EQ(pairs.size(), 512U);
}

}  // namespace
}  // namespace ardrone_vslam
