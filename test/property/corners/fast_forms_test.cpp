// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/fast_scan.hpp"

// Every form of the FAST kernels against the scalar one.
namespace ardrone_vslam::test {
namespace {

using namespace kernels;

std::vector<InstructionSet> vectorSets() {
  std::vector<InstructionSet> sets = supportedInstructionSets();
  sets.erase(std::remove(sets.begin(), sets.end(), InstructionSet::kScalar), sets.end());
  return sets;
}

class FastForms : public testing::TestWithParam<int> {  // arc length
 protected:
  void SetUp() override {
    if (vectorSets().empty()) GTEST_SKIP() << "this processor has the scalar form only";
  }

  std::size_t corners_ = 0;

  /// All rows of the image with these thresholds.
  void expectRowsEqual(const GreyImage& image, const std::vector<std::uint8_t>& thresholds,
                       int x_begin, unsigned columns) {
    const Kernels scalar = kernelsFor(InstructionSet::kScalar);
    for (int y = 3; y < image.height() - 3; ++y) {
      const FastRow row{image.view().row(y), thresholds.data(), x_begin, image.width() - 3,
                        columns};
      const auto expected = scanned(scalar, image, row, GetParam());
      for (const std::uint8_t score : expected) corners_ += score != 0 ? 1 : 0;
      for (const InstructionSet set : vectorSets()) {
        ASSERT_EQ(scanned(kernelsFor(set), image, row, GetParam()), expected)
            << nameOf(set) << " width " << image.width() << " from " << x_begin << " columns "
            << columns << " row " << y;
      }
    }
  }
};

TEST_P(FastForms, RowsOfEveryWidth) {
  std::mt19937 random(11);
  for (int width = 7; width < 7 + 2 * 64 + 3; ++width) {
    for (const GreyImage& image : imagesOfSize(width, 9, random)) {
      std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(width));
      for (auto& threshold : thresholds)
        threshold = static_cast<std::uint8_t>(uniformInt(random, 1, 90));
      expectRowsEqual(image, thresholds, 3, 0xFU);
      expectRowsEqual(image, thresholds, uniformInt(random, 3, std::min(7, width - 3)),
                      static_cast<unsigned>(uniformInt(random, 0, 15)));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(corners_, 1000U);
}

TEST_P(FastForms, EveryThreshold) {
  std::mt19937 random(12);
  for (const GreyImage& image : imagesOfSize(101, 11, random)) {
    for (int threshold = 1; threshold <= 254; ++threshold) {
      const std::vector<std::uint8_t> thresholds(101, static_cast<std::uint8_t>(threshold));
      expectRowsEqual(image, thresholds, 3, 0xFU);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(corners_, 1000U);
}

TEST_P(FastForms, LargeRandomImages) {
  for (const unsigned seed : testSeeds()) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    for (const GreyImage& image : imagesOfSize(uniformInt(random, 150, 700), 15, random)) {
      std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(image.width()));
      for (auto& threshold : thresholds)
        threshold = static_cast<std::uint8_t>(uniformInt(random, 1, 254));
      for (const unsigned columns : {0xFU, 0x5U, 0x1U})
        expectRowsEqual(image, thresholds, 3, columns);
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Arcs, FastForms, testing::Values(9, 10, 11, 12),
                         testing::PrintToStringParamName());

/// Three rows of an image and their maxima, both ways of handling ties.
std::vector<std::uint16_t> maximaOf(const Kernels& kernels, const GreyImage& image, int y,
                                    bool later_may_equal) {
  const std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(image.width()), 10);
  const auto row = [&](int r) {
    return scan(kernels, image,
                {image.view().row(r), thresholds.data(), 3, image.width() - 3, 0xFU}, 9);
  };
  const ScannedRow above = row(y - 1);
  const ScannedRow middle = row(y);
  const ScannedRow below = row(y + 1);
  std::vector<std::uint16_t> columns(static_cast<std::size_t>(image.width() + kMaximaPadding));
  const int count = kernels.fast_maxima(
      {above.scores.data(), middle.scores.data(), below.scores.data(), middle.groups.data(),
       static_cast<int>(middle.groups.size()), later_may_equal},
      columns.data());
  columns.resize(static_cast<std::size_t>(count));
  return columns;
}

std::vector<std::uint16_t> listOf(const Kernels& kernels, const GreyImage& image, int y) {
  const std::vector<std::uint8_t> thresholds(static_cast<std::size_t>(image.width()), 10);
  const ScannedRow row =
      scan(kernels, image, {image.view().row(y), thresholds.data(), 3, image.width() - 3, 0xFU}, 9);
  std::vector<std::uint16_t> columns(static_cast<std::size_t>(image.width() + kMaximaPadding));
  const int count = kernels.fast_list(row.scores.data(), row.groups.data(),
                                      static_cast<int>(row.groups.size()), columns.data());
  columns.resize(static_cast<std::size_t>(count));
  return columns;
}

TEST(FastMaxima, EqualScalarForEveryWidth) {
  std::size_t maxima = 0;
  std::mt19937 random(13);
  for (int width = 7; width < 7 + 2 * 64 + 3; ++width) {
    for (const GreyImage& image : imagesOfSize(width, 14, random)) {
      for (int y = 4; y < image.height() - 4; ++y) {
        for (const bool later_may_equal : {false, true}) {
          const auto expected =
              maximaOf(kernelsFor(InstructionSet::kScalar), image, y, later_may_equal);
          maxima += expected.size();
          for (const InstructionSet set : supportedInstructionSets()) {
            ASSERT_EQ(listOf(kernelsFor(set), image, y),
                      listOf(kernelsFor(InstructionSet::kScalar), image, y))
                << nameOf(set) << " width " << width << " row " << y;
            ASSERT_EQ(maximaOf(kernelsFor(set), image, y, later_may_equal), expected)
                << nameOf(set) << " width " << width << " row " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(maxima, 1000U);
}

}  // namespace
}  // namespace ardrone_vslam::test
