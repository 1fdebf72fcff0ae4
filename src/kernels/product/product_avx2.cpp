// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::kernels {

void productTileAvx2(const double* a, const double* b, int terms, double* tile) {
  __m256d upper[kTileColumns];
  __m256d lower[kTileColumns];
  for (int c = 0; c < kTileColumns; ++c) upper[c] = lower[c] = _mm256_setzero_pd();
  for (int t = 0; t < terms; ++t) {
    const __m256d a_upper = _mm256_loadu_pd(a + kTileRows * t);
    const __m256d a_lower = _mm256_loadu_pd(a + kTileRows * t + 4);
    for (int c = 0; c < kTileColumns; ++c) {
      const __m256d factor = _mm256_broadcast_sd(b + c + kTileColumns * t);
      upper[c] = _mm256_add_pd(upper[c], _mm256_mul_pd(a_upper, factor));
      lower[c] = _mm256_add_pd(lower[c], _mm256_mul_pd(a_lower, factor));
    }
  }
  for (int c = 0; c < kTileColumns; ++c) {
    _mm256_storeu_pd(tile + kTileRows * c, upper[c]);
    _mm256_storeu_pd(tile + kTileRows * c + 4, lower[c]);
  }
}

}  // namespace ardrone_vslam::kernels
