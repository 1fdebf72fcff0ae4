// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <vector>

#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam::test {
namespace {

using namespace kernels;
using Means = std::array<std::uint8_t, kFreakPaddedFields>;

int report(bool equal, const char* kernel, int detail) {
  if (!equal) std::printf("%sNeon differs (%d)\n", kernel, detail);
  return equal ? 0 : 1;
}

std::vector<std::uint16_t> integral(decltype(&freakIntegral16Scalar) kernel,
                                    const FreakImage& image, std::ptrdiff_t stride) {
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(stride * (image.height_px + 1)));
  kernel(image, sums.data(), stride);
  // What lies behind a row's entries is undefined.
  for (int y = 0; y <= image.height_px; ++y)
    std::fill(sums.begin() + y * stride + image.width_px + 1, sums.begin() + (y + 1) * stride,
              std::uint16_t{0});
  return sums;
}

int compareIntegrals(std::mt19937& random) {
  int faults = 0;
  for (int width = 1; width < 80; ++width) {
    const int height = width % 3 == 0 ? 300 : 7;
    const std::ptrdiff_t pixel_stride = width + width % 5;
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(pixel_stride * height), 255);
    if (width % 2 == 0) {
      for (auto& pixel : pixels) pixel = static_cast<std::uint8_t>(random());
    }
    const FreakImage image{pixels.data(), pixel_stride, width, height};
    const std::ptrdiff_t stride = freakIntegralStride(width) + width % 4;
    faults += report(integral(freakIntegral16Scalar, image, stride) ==
                         integral(freakIntegral16Neon, image, stride),
                     "freakIntegral16", width);
  }
  return faults;
}

/// Every area of the pattern's boxes and every sum that it can have.
int compareMeans() {
  int faults = 0;
  for (int side = 2; side <= 16; ++side) {
    for (int other = side; other <= std::min(side + 1, 16); ++other) {
      const int stride = side + 3;
      const auto corner = static_cast<std::size_t>(other * stride + side);
      std::vector<std::uint16_t> sums(corner + 2, 0xffff);
      std::array<FreakBox, kFreakPaddedFields> boxes;
      boxes.fill({0, 0, static_cast<std::int8_t>(side), static_cast<std::int8_t>(other)});
      for (int sum = 0; sum <= 255 * side * other; ++sum) {
        sums[corner] = static_cast<std::uint16_t>(sum - 1);
        Means expected{};
        Means found{};
        freakMeansScalar(sums.data(), stride, boxes.data(), expected.data());
        freakMeansNeon(sums.data(), stride, boxes.data(), found.data());
        const bool equal =
            std::equal(found.begin(), found.begin() + kFreakFields, expected.begin());
        faults += report(equal, "freakMeans", sum);
      }
    }
  }
  return faults;
}

template <int kCount>
void drawFields(FreakFieldList<kCount>& list, std::mt19937& random) {
  for (int k = 0; k < kCount; ++k) list.set(k, static_cast<int>(random() % kFreakFields));
}

int compareOrientationAndBits(std::mt19937& random) {
  int faults = 0;
  for (int round = 0; round < 1000; ++round) {
    Means means{};
    for (auto& mean : means) {
      const auto value = static_cast<std::uint8_t>(random());
      mean = static_cast<std::uint8_t>(round % 3 == 0   ? value
                                       : round % 3 == 1 ? value % 3
                                                        : -(value & 1));
    }
    FreakOrientationPairs pairs{};
    drawFields(pairs.i, random);
    drawFields(pairs.j, random);
    for (int k = 0; k < kFreakOrientationPairs; ++k) {
      pairs.weight_x[k] = static_cast<std::int16_t>(static_cast<int>(random() % 2401) - 1200);
      pairs.weight_y[k] = static_cast<std::int16_t>(static_cast<int>(random() % 2401) - 1200);
    }
    std::array<std::int32_t, 2> expected{};
    std::array<std::int32_t, 2> found{};
    freakOrientationScalar(means.data(), pairs, expected.data());
    freakOrientationNeon(means.data(), pairs, found.data());
    faults += report(found == expected, "freakOrientation", round);

    FreakComparisons lists{};
    drawFields(lists.first, random);
    drawFields(lists.second, random);
    std::array<std::uint64_t, 8> expected_words{};
    std::array<std::uint64_t, 8> found_words{};
    freakBitsScalar(means.data(), lists, expected_words.data());
    freakBitsNeon(means.data(), lists, found_words.data());
    faults += report(found_words == expected_words, "freakBits", round);
  }
  return faults;
}

}  // namespace

/// @return number of faults
int testFreakNeon() {
  std::mt19937 random(31);
  return compareIntegrals(random) + compareMeans() + compareOrientationAndBits(random);
}

}  // namespace ardrone_vslam::test
