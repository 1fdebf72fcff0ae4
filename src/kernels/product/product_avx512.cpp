// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::kernels {

void productTileAvx512(const double* a, const double* b, int terms, double* tile) {
  __m512d sum[kTileColumns];
  for (int c = 0; c < kTileColumns; ++c) sum[c] = _mm512_setzero_pd();
  for (int t = 0; t < terms; ++t) {
    const __m512d rows = _mm512_loadu_pd(a + kTileRows * t);
    for (int c = 0; c < kTileColumns; ++c)
      sum[c] = _mm512_add_pd(sum[c], _mm512_mul_pd(rows, _mm512_set1_pd(b[c + kTileColumns * t])));
  }
  for (int c = 0; c < kTileColumns; ++c) _mm512_storeu_pd(tile + kTileRows * c, sum[c]);
}

}  // namespace ardrone_vslam::kernels
