// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set's kernels against the definition in plain words.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "freak/freak_pattern.hpp"
#include "freak/freak_selected_pairs.hpp"
#include "kernels/kernels.hpp"
#include "support/generated_image.hpp"

namespace ardrone_vslam::test {
namespace {

using kernels::FreakBox;
using kernels::kFreakPaddedFields;
using Means = std::array<std::uint8_t, kFreakPaddedFields>;

class FreakKernels : public ::testing::TestWithParam<InstructionSet> {
 protected:
  const kernels::Kernels kernels = kernels::kernelsFor(GetParam());
};

void expectIntegralOf(const TestImage& image, const kernels::Kernels& kernels) {
  const kernels::FreakImage view{image.bytes.data(), image.stride_bytes, image.width_px,
                                 image.height_px};
  for (const std::ptrdiff_t extra : {0, 5}) {
    const std::ptrdiff_t stride = kernels::freakIntegralStride(image.width_px) + extra;
    const auto size = static_cast<std::size_t>(stride * (image.height_px + 1));
    std::vector<std::uint16_t> sums(size + 1, 0xabcd);
    kernels.freak_integral16(view, sums.data(), stride);
    ASSERT_EQ(sums.back(), 0xabcd) << "written beyond its rows";
    std::vector<std::uint16_t> columns(static_cast<std::size_t>(image.width_px));
    for (int y = 0; y <= image.height_px; ++y) {
      const std::uint16_t* row = sums.data() + y * stride;
      ASSERT_EQ(row[0], 0) << y;
      std::uint16_t expected = 0;
      for (int x = 0; x < image.width_px; ++x) {
        auto& column = columns[static_cast<std::size_t>(x)];  // sum of the pixels above
        if (y > 0) column = static_cast<std::uint16_t>(column + image.at(x, y - 1));
        expected = static_cast<std::uint16_t>(expected + column);
        ASSERT_EQ(row[x + 1], expected) << image.width_px << " px wide, at " << x << ", " << y;
      }
    }
  }
}

TEST_P(FreakKernels, IntegralImageOfEveryWidthAndStride) {
  for (int width = 1; width <= 131; ++width) {
    const int height = 1 + width % 5;
    const TestImage image = generatedImage(width, height, static_cast<std::uint32_t>(width));
    TestImage padded(width, height, width + width % 7);
    std::fill(padded.bytes.begin(), padded.bytes.end(), std::uint8_t{255});
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) padded.at(x, y) = image.at(x, y);
    }
    expectIntegralOf(padded, kernels);
  }
}

TEST_P(FreakKernels, IntegralImageWrapsWhereItOverflows) {
  TestImage white(700, 400);
  std::fill(white.bytes.begin(), white.bytes.end(), std::uint8_t{255});
  expectIntegralOf(white, kernels);
}

// (sum + area / 2) / area for every area that occurs and every sum that it can have, in each of the
// 43 places.
TEST_P(FreakKernels, MeanIsTheRoundedDivision) {
  for (int side = 2; side <= 16; ++side) {
    for (int other = side; other <= std::min(side + 1, 16); ++other) {
      const int area = side * other;
      const int stride = side + 3;
      std::vector<std::uint16_t> integral(static_cast<std::size_t>(stride * (other + 1)), 0xffff);
      std::array<FreakBox, kFreakPaddedFields> boxes;
      boxes.fill({0, 0, static_cast<std::int8_t>(side), static_cast<std::int8_t>(other)});
      Means means{};
      for (int sum = 0; sum <= 255 * area; ++sum) {
        integral[static_cast<std::size_t>(other * stride + side)] =
            static_cast<std::uint16_t>(sum - 1);  // the others are -1: it wraps
        kernels.freak_means(integral.data(), stride, boxes.data(), means.data());
        ASSERT_EQ(means[static_cast<std::size_t>(sum % kernels::kFreakFields)],
                  (sum + area / 2) / area)
            << sum << " over " << area;
      }
    }
  }
}

TEST_P(FreakKernels, MeansOfEveryOrientation) {
  const FreakPattern pattern;
  const TestImage image = generatedImage(64, 60);
  const std::ptrdiff_t stride = kernels::freakIntegralStride(64) + 3;
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(61 * stride));
  kernels.freak_integral16({image.bytes.data(), 64, 64, 60}, sums.data(), stride);
  for (int orientation = 0; orientation < kFreakOrientations; ++orientation) {
    for (int evenness = 0; evenness < 4; ++evenness) {
      const int x = 30 + evenness % 2;
      const int y = 30 + evenness / 2;
      const FreakBox* boxes = pattern.boxes(orientation, x, y);
      Means means{};
      kernels.freak_means(sums.data() + y * stride + x, stride, boxes, means.data());
      for (int field = 0; field < kernels::kFreakFields; ++field) {
        const FreakBox box = boxes[field];
        int sum = 0;
        for (int row = box.top; row < box.bottom; ++row) {           // NOLINT(*-signed-char-misuse)
          for (int column = box.left; column < box.right; ++column)  // NOLINT(*-signed-char-misuse)
            sum += image.at(x + column, y + row);
        }
        const int area = (box.right - box.left) * (box.bottom - box.top);
        ASSERT_EQ(means[static_cast<std::size_t>(field)], (sum + area / 2) / area)
            << "orientation " << orientation << " field " << field;
      }
    }
  }
}

/// Random means: of the whole range, of few values (many are equal), or extreme.
Means drawMeans(std::mt19937& random) {
  const int kind = static_cast<int>(random() % 3);
  Means means{};
  for (auto& mean : means) {
    const auto value = static_cast<std::uint8_t>(random());
    mean = kind == 0 ? value : static_cast<std::uint8_t>(kind == 1 ? value % 3 : -(value & 1));
  }
  return means;
}

TEST_P(FreakKernels, OrientationSumsAndComparisonsOfRandomMeans) {
  const FreakPattern pattern;
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto& pairs = pattern.orientationPairs();
  const auto& lists = pattern.comparisons();
  for (int round = 0; round < 3000; ++round) {
    const Means means = drawMeans(random);
    int sum_x = 0;
    int sum_y = 0;
    for (int k = 0; k < kernels::kFreakOrientationPairs; ++k) {
      const int difference = means[pairs.i.index[k]] - means[pairs.j.index[k]];
      sum_x += difference * pairs.weight_x[k] / 2048;
      sum_y += difference * pairs.weight_y[k] / 2048;
    }
    std::array<std::int32_t, 2> sums{};
    kernels.freak_orientation(means.data(), pairs, sums.data());
    ASSERT_EQ(sums, (std::array<std::int32_t, 2>{sum_x, sum_y}));

    std::array<std::uint64_t, 8> words{};
    kernels.freak_bits(means.data(), lists, words.data());
    for (std::size_t bit = 0; bit < kFreakBits; ++bit) {
      const std::size_t entry = 64 * (bit % 8) + bit / 8;
      const bool expected = means[lists.first.index[entry]] >= means[lists.second.index[entry]];
      ASSERT_EQ((words[bit / 64] >> (bit % 64)) & 1U, expected ? 1U : 0U) << "bit " << bit;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, FreakKernels, ::testing::ValuesIn(supportedInstructionSets()),
                         [](const auto& parameter) {
                           return std::string(nameOf(parameter.param));
                         });

}  // namespace
}  // namespace ardrone_vslam::test
