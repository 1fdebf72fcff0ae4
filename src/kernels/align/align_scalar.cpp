// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/align/align_loop.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// See align_loop.hpp.
class Comparison {
 public:
  explicit Comparison(const AlignPatch& patch) : patch_(patch) {}

  AlignSums compare(const std::uint8_t* pixels, std::ptrdiff_t stride_bytes,
                    std::int32_t fraction_x, std::int32_t fraction_y) const {
    AlignSums sums;
    for (int row = 0; row < kPatchSide; ++row) {
      const std::uint8_t* above = pixels + row * stride_bytes;
      const std::uint8_t* below = above + stride_bytes;
      const auto& rows = patch_.rows;
      const int y = row + kPatchBorder;
      for (int column = 0; column < kPatchSide; ++column) {
        const std::int32_t level =
            weigh(between(above + column, fraction_x), kAlignSteps - fraction_y) +
            weigh(between(below + column, fraction_x), fraction_y);
        const int x = column + kPatchBorder;
        sums.gradient_x += level * (rows[y][x + 1] - rows[y][x - 1]);
        sums.gradient_y += level * (rows[y + 1][x] - rows[y - 1][x]);
        sums.level += level * rows[y][x];
        sums.one += level;
        sums.square += level * level;
      }
    }
    return sums;
  }

 private:
  static std::int32_t between(const std::uint8_t* pixel, std::int32_t fraction) {
    return pixel[0] * (kAlignSteps - fraction) + pixel[1] * fraction;
  }
  static std::int32_t weigh(std::int32_t level, std::int32_t share) {
    return (level * (share * kRowWeight) + (1 << 14)) >> 15;
  }

  const AlignPatch& patch_;
};

}  // namespace

AlignResult alignScalar(const AlignPatch& patch, const std::uint8_t* pixels,
                        std::ptrdiff_t stride_bytes, float x_px, float y_px) {
  return alignBy<Comparison>(patch, pixels, stride_bytes, x_px, y_px);
}

}  // namespace ardrone_vslam::kernels
