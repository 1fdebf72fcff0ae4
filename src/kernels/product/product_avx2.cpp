// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::kernels {

void productTileAvx2(const float* a, const float* b, int terms, float* tile) {
  __m256 sum[kTileColumns];
  for (int c = 0; c < kTileColumns; ++c) sum[c] = _mm256_setzero_ps();
  for (int t = 0; t < terms; ++t) {
    const __m256 rows = _mm256_loadu_ps(a + kTileRows * t);
    for (int c = 0; c < kTileColumns; ++c) {
      const __m256 factor = _mm256_broadcast_ss(b + c + kTileColumns * t);
      sum[c] = _mm256_add_ps(sum[c], _mm256_mul_ps(rows, factor));
    }
  }
  for (int c = 0; c < kTileColumns; ++c) _mm256_storeu_ps(tile + kTileRows * c, sum[c]);
}

}  // namespace ardrone_vslam::kernels
