// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/align/align_loop.hpp"

namespace ardrone_vslam::kernels {
namespace {

inline int16x8_t row(const AlignPatch& patch, int y, int x) {
  return vreinterpretq_s16_u16(vmovl_u8(vld1_u8(&patch.rows[y][x])));
}

inline std::int32_t sum(int32x4_t lanes) {
  const int32x2_t half = vadd_s32(vget_low_s32(lanes), vget_high_s32(lanes));
  return vget_lane_s32(vpadd_s32(half, half), 0);
}

inline int32x4_t addProducts(int32x4_t sums, int16x8_t a, int16x8_t b) {
  sums = vmlal_s16(sums, vget_low_s16(a), vget_low_s16(b));
  return vmlal_s16(sums, vget_high_s16(a), vget_high_s16(b));
}

/// A row of a patch in a vector; see align_loop.hpp.
class Comparison {
 public:
  explicit Comparison(const AlignPatch& patch) {
    for (int i = 0; i < kPatchSide; ++i) {
      const int y = i + kPatchBorder;
      level_[i] = row(patch, y, kPatchBorder);
      gradient_x_[i] = vsubq_s16(row(patch, y, kPatchBorder + 1), row(patch, y, kPatchBorder - 1));
      gradient_y_[i] = vsubq_s16(row(patch, y + 1, kPatchBorder), row(patch, y - 1, kPatchBorder));
    }
  }

  AlignSums compare(const std::uint8_t* pixels, std::ptrdiff_t stride_bytes,
                    std::int32_t fraction_x, std::int32_t fraction_y) const {
    const uint8x8_t left = vdup_n_u8(static_cast<std::uint8_t>(kAlignSteps - fraction_x));
    const uint8x8_t right = vdup_n_u8(static_cast<std::uint8_t>(fraction_x));
    const auto between = [&](const std::uint8_t* pixel) {
      return vreinterpretq_s16_u16(
          vmlal_u8(vmull_u8(vld1_u8(pixel), left), vld1_u8(pixel + 1), right));
    };
    const int16x8_t above = weight(kAlignSteps - fraction_y);
    const int16x8_t below = weight(fraction_y);
    int32x4_t gradient_x = vdupq_n_s32(0);
    int32x4_t gradient_y = gradient_x;
    int32x4_t level = gradient_x;
    int32x4_t one = gradient_x;
    int32x4_t square = gradient_x;
    int16x8_t line = between(pixels);
    for (int i = 0; i < kPatchSide; ++i) {
      pixels += stride_bytes;
      const int16x8_t next = between(pixels);
      const int16x8_t image = vaddq_s16(vqrdmulhq_s16(line, above), vqrdmulhq_s16(next, below));
      line = next;
      gradient_x = addProducts(gradient_x, image, gradient_x_[i]);
      gradient_y = addProducts(gradient_y, image, gradient_y_[i]);
      level = addProducts(level, image, level_[i]);
      one = vpadalq_s16(one, image);
      square = addProducts(square, image, image);
    }
    return {sum(gradient_x), sum(gradient_y), sum(level), sum(one), sum(square)};
  }

 private:
  static int16x8_t weight(std::int32_t share) {
    return vdupq_n_s16(static_cast<std::int16_t>(share * kRowWeight));
  }

  int16x8_t level_[kPatchSide];
  int16x8_t gradient_x_[kPatchSide];
  int16x8_t gradient_y_[kPatchSide];
};

}  // namespace

AlignResult alignNeon(const AlignPatch& patch, const std::uint8_t* pixels,
                      std::ptrdiff_t stride_bytes, float x_px, float y_px) {
  return alignBy<Comparison>(patch, pixels, stride_bytes, x_px, y_px);
}

}  // namespace ardrone_vslam::kernels
