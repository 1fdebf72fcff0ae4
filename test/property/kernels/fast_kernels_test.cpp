// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/fast/fast_kernels.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/fast_oracle.hpp"
#include "support/fast_scan.hpp"
#include "support/grey_images.hpp"

namespace ardrone_vslam::test {
namespace {

using namespace kernels;

constexpr int kArcs[] = {9, 10, 11, 12};

/// 7x7 image whose middle pixel is `centre` and whose circle is 200 where the mask has a 1, else
/// 100.
GreyImage circleImage(unsigned mask, std::uint8_t centre) {
  GreyImage image(7, 7, 3, centre);
  for (int n = 0; n < kCircleSize; ++n) {
    const bool one = ((mask >> n) & 1U) != 0;
    image.at(3 + kCircle[n].x_px, 3 + kCircle[n].y_px) = one ? 200 : 100;
  }
  return image;
}

const std::uint8_t* pixelAt(const GreyImage& image, int x, int y) {
  return image.view().row(y) + x;
}

TEST(FastCircle, IsTheClosedBresenhamCircle) {
  std::set<std::pair<int, int>> different;
  for (int n = 0; n < kCircleSize; ++n) {
    const CircleOffset& a = kCircle[n];
    const CircleOffset& b = kCircle[(n + 1) % kCircleSize];
    different.insert({a.x_px, a.y_px});
    EXPECT_LE(std::abs(a.x_px - b.x_px), 1) << n;
    EXPECT_LE(std::abs(a.y_px - b.y_px), 1) << n;
    EXPECT_EQ(kCircle[(n + 8) % kCircleSize].x_px, -a.x_px) << n;
    EXPECT_EQ(kCircle[(n + 8) % kCircleSize].y_px, -a.y_px) << n;
  }
  EXPECT_EQ(different.size(), 16U);
  EXPECT_EQ(std::set<int>(std::begin(kTestOrder), std::end(kTestOrder)).size(), 16U);
}

// The definition on bits: s ones in a row around the circle.
bool hasRun(unsigned mask, int arc) {
  const unsigned twice = mask | (mask << 16U);
  for (int start = 0; start < 16; ++start) {
    const unsigned run = ((1U << static_cast<unsigned>(arc)) - 1U) << static_cast<unsigned>(start);
    if ((twice & run) == run) return true;
  }
  return false;
}

TEST(NonConformingArc, StopsExactlyWhereNoCornerIsPossible) {
  for (const int arc : kArcs) {
    for (unsigned mask = 0; mask < 65536U; ++mask) {
      NonConformingArc tracker(arc);
      unsigned possible = 0xFFFFU;  // pixels not known to be non-conforming
      bool open = true;
      for (const int n : kTestOrder) {
        if (((mask >> n) & 1U) != 0) continue;
        possible &= ~(1U << n);
        open = tracker.add(n);
        // Not only the final answer: the test stops at once, and never too early.
        ASSERT_EQ(open, hasRun(possible, arc)) << "s " << arc << " mask " << mask << " pixel " << n;
        if (!open) break;
      }
      ASSERT_EQ(open, hasRun(mask, arc)) << "s " << arc << " mask " << mask;
    }
  }
}

TEST(FastTest, EqualsTheDefinitionForEveryMaskAndBothPolarities) {
  for (unsigned mask = 0; mask < 65536U; ++mask) {
    // 100 | 200 around a centre: one polarity at a time, then both at once.
    for (const std::uint8_t centre : {std::uint8_t{100}, std::uint8_t{200}, std::uint8_t{150}}) {
      const GreyImage image = circleImage(mask, centre);
      for (const int arc : kArcs) {
        const FastCircle circle = fastCircle(image.view().stride_bytes, arc);
        const bool ones = centre != 200 && hasRun(mask, arc);
        const bool zeros = centre != 100 && hasRun(~mask & 0xFFFFU, arc);
        ASSERT_EQ(fastTestScalar(pixelAt(image, 3, 3), circle, 40), ones || zeros)
            << "s " << arc << " mask " << mask << " centre " << int{centre};
      }
    }
  }
}

TEST(FastTest, ThresholdIsExclusive) {
  const GreyImage image = circleImage(0xFFFFU, 150);
  const FastCircle circle = fastCircle(image.view().stride_bytes, 12);
  EXPECT_TRUE(fastTestScalar(pixelAt(image, 3, 3), circle, 49));
  EXPECT_FALSE(fastTestScalar(pixelAt(image, 3, 3), circle, 50));
  EXPECT_EQ(fastScoreScalar(pixelAt(image, 3, 3), circle), 49);
}

TEST(FastScore, IsNotTheLeastOfAllConformingDifferences) {
  // Twelve differences of 100, four of 36: (3.2) as printed gives 36.
  GreyImage image = circleImage(0x0FFFU, 100);
  for (int n = 12; n < 16; ++n) image.at(3 + kCircle[n].x_px, 3 + kCircle[n].y_px) = 136;
  const FastCircle circle = fastCircle(image.view().stride_bytes, 12);
  EXPECT_EQ(fastScoreScalar(pixelAt(image, 3, 3), circle), 99);
}

TEST(FastScore, CoversTheWholeRange) {
  GreyImage image(7, 7, 0, 255);
  const FastCircle circle = fastCircle(image.view().stride_bytes, 9);
  EXPECT_EQ(fastScoreScalar(pixelAt(image, 3, 3), circle), 0);
  image.at(3, 3) = 0;
  EXPECT_EQ(fastScoreScalar(pixelAt(image, 3, 3), circle), 254);
  EXPECT_TRUE(fastTestScalar(pixelAt(image, 3, 3), circle, 254));
  EXPECT_FALSE(fastTestScalar(pixelAt(image, 3, 3), circle, 255));
}

TEST(FastScore, EqualsTryingEveryThreshold) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const GreyImage& image : variedImages(seed)) {
      for (const int arc : kArcs) {
        const FastCircle circle = fastCircle(image.view().stride_bytes, arc);
        for (int y = 3; y < image.height() - 3; ++y) {
          for (int x = 3; x < image.width() - 3; ++x) {
            ASSERT_EQ(fastScoreScalar(pixelAt(image, x, y), circle),
                      scoreByDefinition(image, {y, x}, arc))
                << "s " << arc << " at " << x << ", " << y;
          }
        }
      }
    }
  }
}

/// Every pixel of every row, each column with a threshold of its own.
void expectRowsEqualDefinition(const GreyImage& image, int arc, unsigned columns,
                               std::mt19937& random) {
  std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(image.width()));
  for (auto& threshold : thresholds)
    threshold = static_cast<std::uint8_t>(uniformInt(random, 1, 120));
  for (int y = 3; y < image.height() - 3; ++y) {
    const int begin = uniformInt(random, 3, image.width() - 3);
    const int end = uniformInt(random, begin, image.width() - 3);
    const FastRow row{image.view().row(y), thresholds.data(), begin, end, columns};
    std::vector<std::uint8_t> expected(thresholds.size(), 0);
    for (int x = begin; x < end; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const bool tested = ((columns >> (x % 4)) & 1U) != 0;
      if (tested && isCornerByDefinition(image, {y, x}, arc, thresholds[i]))
        expected[i] = static_cast<std::uint8_t>(scoreByDefinition(image, {y, x}, arc));
    }
    ASSERT_EQ(scanned(kernelsFor(InstructionSet::kScalar), image, row, arc), expected)
        << "s " << arc << " columns " << columns << " row " << y;
  }
}

TEST(FastRow, EqualsTheDefinitionForAllColumnsAndArcs) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    for (const GreyImage& image : variedImages(seed)) {
      for (const int arc : kArcs) {
        for (unsigned columns = 0; columns < 16U; ++columns)
          expectRowsEqualDefinition(image, arc, columns, random);
      }
    }
  }
}

}  // namespace
}  // namespace ardrone_vslam::test
