// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam::kernels {

/// Size of the piece of a matrix product whose sums stay in registers.
constexpr int kTileRows = 8;
constexpr int kTileColumns = 4;

/// A tile of a product of matrices: tile[r + 8 c] = sum over t of a[r + 8 t] * b[c + 4 t], summed
/// in the order of t, no product fused with a sum. The scalar form is the definition: the others
/// give the same numbers, bit for bit; NEON of ARMv7 takes numbers below 1e-38 for zero.
void productTileScalar(const float* a, const float* b, int terms, float* tile);
void productTileAvx2(const float* a, const float* b, int terms, float* tile);
void productTileNeon(const float* a, const float* b, int terms, float* tile);

}  // namespace ardrone_vslam::kernels
