// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam::kernels {

/// Size of the piece of a matrix product whose sums stay in registers.
constexpr int kTileRows = 8;
constexpr int kTileColumns = 4;

/// A tile of a product of matrices: tile[r + 8 c] = sum over t of a[r + 8 t] * b[c + 4 t], summed
/// in the order of t, no product fused with a sum. The scalar form is the definition: the others
/// give the same numbers, bit for bit. (NEON has no vectors of doubles on ARMv7; on ARMv8 the
/// compiler makes some of the scalar form.)
void productTileScalar(const double* a, const double* b, int terms, double* tile);
void productTileAvx2(const double* a, const double* b, int terms, double* tile);
void productTileAvx512(const double* a, const double* b, int terms, double* tile);

}  // namespace ardrone_vslam::kernels
