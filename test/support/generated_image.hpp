// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam::test {

/// Marsaglia's xorshift32: the same numbers on every machine and with every standard library.
class XorShift32 {
 public:
  explicit XorShift32(std::uint32_t seed) : state_(seed) {}
  std::uint32_t operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }

 private:
  std::uint32_t state_;
};

/// A grey image that owns its pixels; `row_stride` may be larger than the width.
struct TestImage {
  TestImage(int width, int height, std::ptrdiff_t row_stride)
      : width_px(width),
        height_px(height),
        stride_bytes(row_stride),
        bytes(static_cast<std::size_t>(row_stride) * static_cast<std::size_t>(height)) {}
  TestImage(int width, int height) : TestImage(width, height, width) {}

  std::uint8_t& at(int x, int y) { return bytes[static_cast<std::size_t>(y * stride_bytes + x)]; }
  std::uint8_t at(int x, int y) const {
    return bytes[static_cast<std::size_t>(y * stride_bytes + x)];
  }
  ImageView view() const { return {bytes.data(), width_px, height_px, stride_bytes}; }

  int width_px, height_px;
  std::ptrdiff_t stride_bytes;
  std::vector<std::uint8_t> bytes;
};

/// Noise of several pixels' size: bytes of xorshift32, then the 5 x 5 box mean with replicated
/// border.
inline TestImage generatedImage(int width, int height, std::uint32_t seed = 2463534242U) {
  TestImage noise(width, height);
  XorShift32 draw(seed);
  for (auto& byte : noise.bytes) byte = static_cast<std::uint8_t>(draw() >> 24);
  TestImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int sum = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          sum += noise.at(std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1));
        }
      }
      image.at(x, y) = static_cast<std::uint8_t>(sum / 25);
    }
  }
  return image;
}

/// FNV-1a with 64 bits.
inline std::uint64_t hashOf(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3U;
  return hash;
}

}  // namespace ardrone_vslam::test
