// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Eight words' running sums by doubling.
uint16x8_t runningSums(uint16x8_t words) {
  const uint16x8_t zero = vdupq_n_u16(0);
  words = vaddq_u16(words, vextq_u16(zero, words, 7));
  words = vaddq_u16(words, vextq_u16(zero, words, 6));
  return vaddq_u16(words, vextq_u16(zero, words, 4));
}

/// 8 pixels of a row of the integral image.
/// @param carry  sum of the row's pixels before them, in all words; advanced
void integrate8(uint8x8_t pixels, const std::uint16_t* above, std::uint16_t* row,
                uint16x8_t& carry) {
  const uint16x8_t sums = vaddq_u16(runningSums(vmovl_u8(pixels)), carry);
  carry = vdupq_lane_u16(vget_high_u16(sums), 3);
  vst1q_u16(row, vaddq_u16(sums, vld1q_u16(above)));
}

/// The box's pixel sum modulo 2^16.
std::uint16_t boxSum(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, FreakBox box) {
  const std::uint16_t* top = at_keypoint + box.top * stride;
  const std::uint16_t* bottom = at_keypoint + box.bottom * stride;
  return static_cast<std::uint16_t>(bottom[box.right] - bottom[box.left] - top[box.right] +
                                    top[box.left]);
}

/// Rounded quotients of four boxes. The quotient by an approximate reciprocal is right or off by
/// one; the remainder tells.
uint16x4_t fourMeans(uint16x4_t sums, uint16x4_t areas) {
  const uint32x4_t area = vmovl_u16(areas);
  const uint32x4_t dividend = vaddw_u16(vshrq_n_u32(area, 1), sums);
  const float32x4_t divisor = vcvtq_f32_u32(area);
  float32x4_t reciprocal = vrecpeq_f32(divisor);  // 8 bits, doubled by each of Newton's steps
  reciprocal = vmulq_f32(vrecpsq_f32(divisor, reciprocal), reciprocal);
  reciprocal = vmulq_f32(vrecpsq_f32(divisor, reciprocal), reciprocal);
  // (dividend + 1 / 2) / area is at least 1 / 512 from every integer; floats err by less than
  // 2^-13 below 256: the integer part is exact.
  const float32x4_t raised = vaddq_f32(vcvtq_f32_u32(dividend), vdupq_n_f32(0.5F));
  return vmovn_u32(vcvtq_u32_f32(vmulq_f32(raised, reciprocal)));
}

/// The means, where table look-ups find them.
struct MeanTable {
  explicit MeanTable(const std::uint8_t* means) {
    for (int d = 0; d < 4; ++d) low.val[d] = vld1_u8(means + 8 * d);
    for (int d = 0; d < 2; ++d) high.val[d] = vld1_u8(means + 32 + 8 * d);
  }
  uint8x8_t look(const std::uint8_t* fields) const {
    const uint8x8_t index = vld1_u8(fields);
    return vtbx2_u8(vtbl4_u8(low, index), high, vsub_u8(index, vdup_n_u8(32)));
  }
  uint8x8x4_t low;   // fields 0..31
  uint8x8x2_t high;  // fields 32..47
};

/// Adds difference * weight / 2048, each truncated, of eight pairs.
int32x4_t addWeighed(int32x4_t sum, int16x8_t difference, const std::int16_t* weights) {
  const int16x8_t weight = vld1q_s16(weights);
  // The magnitude is shifted, so it is truncated; the sign comes after it.
  const int16x8_t magnitude = vabsq_s16(difference);
  const int16x8_t negative = vshrq_n_s16(veorq_s16(difference, weight), 15);
  const int16x8_t size = vabsq_s16(weight);
  const int32x4_t low = vshrq_n_s32(vmull_s16(vget_low_s16(magnitude), vget_low_s16(size)), 11);
  const int32x4_t high = vshrq_n_s32(vmull_s16(vget_high_s16(magnitude), vget_high_s16(size)), 11);
  const int16x8_t terms = vcombine_s16(vmovn_s32(low), vmovn_s32(high));
  return vpadalq_s16(sum, vsubq_s16(veorq_s16(terms, negative), negative));
}

std::int32_t total(int32x4_t sums) {
  return static_cast<std::int32_t>(
      vget_lane_s64(vpaddl_s32(vadd_s32(vget_low_s32(sums), vget_high_s32(sums))), 0));
}

}  // namespace

void freakIntegral16Neon(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride) {
  for (int x = 0; x <= image.width_px; ++x) sums[x] = 0;
  const int whole_px = image.width_px / 8 * 8;
  std::uint8_t rest[8] = {};
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint8_t* pixels = image.pixels + y * image.stride_bytes;
    const std::uint16_t* above = sums + y * stride + 1;
    std::uint16_t* row = sums + (y + 1) * stride + 1;
    row[-1] = 0;
    uint16x8_t carry = vdupq_n_u16(0);
    for (int x = 0; x < whole_px; x += 8)
      integrate8(vld1_u8(pixels + x), above + x, row + x, carry);
    if (whole_px == image.width_px) continue;
    for (int x = whole_px; x < image.width_px; ++x) rest[x - whole_px] = pixels[x];
    integrate8(vld1_u8(rest), above + whole_px, row + whole_px, carry);
  }
}

void freakMeansNeon(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, const FreakBox* boxes,
                    std::uint8_t* means) {
  std::uint16_t sums[kFreakPaddedFields];
  std::uint16_t areas[kFreakPaddedFields];
  for (int k = 0; k < kFreakPaddedFields; ++k) {
    const FreakBox box = boxes[k];
    sums[k] = boxSum(at_keypoint, stride, box);
    areas[k] = static_cast<std::uint16_t>((box.right - box.left) * (box.bottom - box.top));
  }
  for (int k = 0; k < kFreakPaddedFields; k += 8) {
    const uint16x8_t eight =
        vcombine_u16(fourMeans(vld1_u16(sums + k), vld1_u16(areas + k)),
                     fourMeans(vld1_u16(sums + k + 4), vld1_u16(areas + k + 4)));
    vst1_u8(means + k, vmovn_u16(eight));
  }
}

void freakOrientationNeon(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                          std::int32_t* sums) {
  const MeanTable table(means);
  int32x4_t sum_x = vdupq_n_s32(0);
  int32x4_t sum_y = vdupq_n_s32(0);
  for (int k = 0; k < kFreakOrientationPairs; k += 8) {
    const int16x8_t difference = vreinterpretq_s16_u16(
        vsubl_u8(table.look(pairs.i.index + k), table.look(pairs.j.index + k)));
    sum_x = addWeighed(sum_x, difference, pairs.weight_x + k);
    sum_y = addWeighed(sum_y, difference, pairs.weight_y + k);
  }
  sums[0] = total(sum_x);
  sums[1] = total(sum_y);
}

void freakBitsNeon(const std::uint8_t* means, const FreakComparisons& lists, std::uint64_t* words) {
  const MeanTable table(means);
  for (int w = 0; w < kFreakComparisons / 64; ++w) {
    uint8x8_t bits = vdup_n_u8(0);
    for (int q = 0; q < 8; ++q) {
      const int entry = 64 * q + 8 * w;
      const uint8x8_t not_less =
          vcge_u8(table.look(lists.first.index + entry), table.look(lists.second.index + entry));
      bits = vorr_u8(bits, vand_u8(not_less, vdup_n_u8(static_cast<std::uint8_t>(1 << q))));
    }
    words[w] = vget_lane_u64(vreinterpret_u64_u8(bits), 0);
  }
}

}  // namespace ardrone_vslam::kernels
