// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

constexpr int kLargestArea = 256;

/// ceil(2^24 / area). With it (v * reciprocal) >> 24 equals v / area for every v = sum + area / 2
/// that can occur: the excess is v (area - 1) / 2^24 of one part in `area` and v (area - 1) <=
/// 65408 * 255 < 2^24; the product stays below 255.5 * 2^24 + 65408 < 2^32. (The drone's Cortex-A8
/// has no divider.)
struct Reciprocals {
  std::uint32_t of[kLargestArea + 1];
};
constexpr Reciprocals reciprocals() {
  Reciprocals table{};
  for (std::uint32_t area = 1; area <= kLargestArea; ++area) {
    table.of[area] = ((1U << 24) + area - 1) / area;
  }
  return table;
}
constexpr auto kReciprocals = reciprocals();

template <class Sum>
void integral(const FreakImage& image, Sum* sums, std::ptrdiff_t stride) {
  for (int x = 0; x <= image.width_px; ++x) sums[x] = 0;
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint8_t* pixels = image.pixels + y * image.stride_bytes;
    const Sum* above = sums + y * stride;
    Sum* row = sums + (y + 1) * stride;
    std::uint32_t row_sum = 0;
    row[0] = 0;
    for (int x = 0; x < image.width_px; ++x) {
      row_sum += pixels[x];
      row[x + 1] = static_cast<Sum>(above[x + 1] + row_sum);  // wraps on purpose
    }
  }
}

}  // namespace

void freakIntegral16Scalar(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride) {
  integral(image, sums, stride);
}

void freakIntegral32Scalar(const FreakImage& image, std::uint32_t* sums, std::ptrdiff_t stride) {
  integral(image, sums, stride);
}

void freakMeansScalar(const std::uint16_t* at_keypoint, std::ptrdiff_t stride,
                      const FreakBox* boxes, std::uint8_t* means) {
  for (int field = 0; field < kFreakFields; ++field) {
    const FreakBox box = boxes[field];
    const std::uint16_t* top = at_keypoint + box.top * stride;
    const std::uint16_t* bottom = at_keypoint + box.bottom * stride;
    const auto sum = static_cast<std::uint16_t>(bottom[box.right] - bottom[box.left] -
                                                top[box.right] + top[box.left]);
    const auto area = static_cast<std::uint32_t>((box.right - box.left) * (box.bottom - box.top));
    means[field] = static_cast<std::uint8_t>(((sum + area / 2) * kReciprocals.of[area]) >> 24);
  }
}

void freakOrientationScalar(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                            std::int32_t* sums) {
  std::int32_t sum_x = 0;
  std::int32_t sum_y = 0;
  for (int k = 0; k < kFreakOrientationPairs; ++k) {
    const int difference = means[pairs.i.index[k]] - means[pairs.j.index[k]];
    sum_x += difference * pairs.weight_x[k] / 2048;
    sum_y += difference * pairs.weight_y[k] / 2048;
  }
  sums[0] = sum_x;
  sums[1] = sum_y;
}

void freakBitsScalar(const std::uint8_t* means, const FreakComparisons& lists,
                     std::uint64_t* words) {
  for (int w = 0; w < kFreakComparisons / 64; ++w) {
    std::uint64_t word = 0;
    for (int q = 0; q < 8; ++q) {
      for (int b = 0; b < 8; ++b) {
        const int entry = 64 * q + 8 * w + b;
        const bool bit = means[lists.first.index[entry]] >= means[lists.second.index[entry]];
        word |= static_cast<std::uint64_t>(bit) << (8 * b + q);
      }
    }
    words[w] = word;
  }
}

}  // namespace ardrone_vslam::kernels
