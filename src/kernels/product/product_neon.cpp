// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// The product is rounded before it is added: VMLA of ARMv7 does so, too, in half the time.
template <int kLane>
inline float32x4_t plusProduct(float32x4_t sum, float32x4_t rows, float32x2_t factors) {
#ifdef __aarch64__
  return vaddq_f32(sum, vmulq_lane_f32(rows, factors, kLane));
#else
  return vmlaq_lane_f32(sum, rows, factors, kLane);
#endif
}

struct Columns {
  float32x4_t first, second, third, fourth;

  void add(float32x4_t rows, float32x4_t factors) {
    first = plusProduct<0>(first, rows, vget_low_f32(factors));
    second = plusProduct<1>(second, rows, vget_low_f32(factors));
    third = plusProduct<0>(third, rows, vget_high_f32(factors));
    fourth = plusProduct<1>(fourth, rows, vget_high_f32(factors));
  }
  void store(float* tile) const {
    vst1q_f32(tile, first);
    vst1q_f32(tile + kTileRows, second);
    vst1q_f32(tile + 2 * kTileRows, third);
    vst1q_f32(tile + 3 * kTileRows, fourth);
  }
};

}  // namespace

void productTileNeon(const float* a, const float* b, int terms, float* tile) {
  static_assert(kTileRows == 8 && kTileColumns == 4);
  const float32x4_t zero = vdupq_n_f32(0);
  Columns upper{zero, zero, zero, zero};
  Columns lower{zero, zero, zero, zero};
  for (int t = 0; t < terms; ++t) {
    const float32x4_t factors = vld1q_f32(b + kTileColumns * t);
    upper.add(vld1q_f32(a + kTileRows * t), factors);
    lower.add(vld1q_f32(a + kTileRows * t + 4), factors);
  }
  upper.store(tile);
  lower.store(tile + 4);
}

}  // namespace ardrone_vslam::kernels
