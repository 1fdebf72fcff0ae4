// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/product/product_kernels.hpp"

namespace ardrone_vslam::kernels {

void productTileScalar(const float* a, const float* b, int terms, float* tile) {
  // So many rows at a time that the sums stay in registers.
  constexpr int kRows = kTileRows / 2;
  for (int first = 0; first < kTileRows; first += kRows) {
    float sum[kTileColumns][kRows] = {};
    for (int t = 0; t < terms; ++t) {
      for (int c = 0; c < kTileColumns; ++c) {
        for (int r = 0; r < kRows; ++r)
          sum[c][r] += a[first + r + kTileRows * t] * b[c + kTileColumns * t];
      }
    }
    for (int c = 0; c < kTileColumns; ++c) {
      for (int r = 0; r < kRows; ++r) tile[first + r + kTileRows * c] = sum[c][r];
    }
  }
}

}  // namespace ardrone_vslam::kernels
