// SPDX-License-Identifier: BSD-3-Clause
#include "alignment/patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace ardrone_vslam {
namespace {

using kernels::AlignPatch;
using kernels::kPatchBorder;
using kernels::kPatchSide;

constexpr float kPixels = kPatchSide * kPatchSide;

/// Sums over the compared pixels' gradients along x and y, and levels: whole numbers, so that they
/// are the same on every machine.
struct PatchSums {
  Eigen::Vector3i sum = Eigen::Vector3i::Zero();
  Eigen::Matrix3i products = Eigen::Matrix3i::Zero();
};

using Column = std::int16_t[kPatchSide * kPatchSide];

int sumOf(const Column& column) {
  int sum = 0;
  for (const std::int16_t value : column) sum += value;
  return sum;
}

int productOf(const Column& a, const Column& b) {
  int sum = 0;
  for (int i = 0; i < kPatchSide * kPatchSide; ++i) sum += int{a[i]} * int{b[i]};
  return sum;
}

// Columns of 16 bits: of these a compiler makes vectors.
PatchSums sumsOf(const AlignPatch& patch) {
  alignas(16) Column columns[3];
  for (int row = 0; row < kPatchSide; ++row) {
    for (int column = 0; column < kPatchSide; ++column) {
      const int i = row * kPatchSide + column;
      const int y = row + kPatchBorder;
      const int x = column + kPatchBorder;
      columns[0][i] = static_cast<std::int16_t>(patch.rows[y][x + 1] - patch.rows[y][x - 1]);
      columns[1][i] = static_cast<std::int16_t>(patch.rows[y + 1][x] - patch.rows[y - 1][x]);
      columns[2][i] = patch.rows[y][x];
    }
  }
  PatchSums sums;
  for (int a = 0; a < 3; ++a) {
    sums.sum[a] = sumOf(columns[a]);
    for (int b = a; b < 3; ++b)
      sums.products(a, b) = sums.products(b, a) = productOf(columns[a], columns[b]);
  }
  return sums;
}

}  // namespace

std::optional<AlignPatch> patchOf(const ImageView& image, int x_px, int y_px) {
  assert(x_px >= kernels::kPatchStride && x_px < image.width_px - kernels::kPatchStride &&
         y_px >= kernels::kPatchStride && y_px < image.height_px - kernels::kPatchStride &&
         "the patch is too near to the image's border");
  AlignPatch patch;
  for (int row = 0; row < kernels::kPatchRows; ++row) {
    std::memcpy(patch.rows[row],
                image.row(y_px + row - kernels::kPatchCentre) + x_px - kernels::kPatchCentre,
                kernels::kPatchStride);
  }
  const PatchSums sums = sumsOf(patch);
  const Eigen::Vector3d mean = sums.sum.cast<double>() / kPixels;
  const Eigen::Matrix3d products =
      sums.products.cast<double>() - mean * sums.sum.cast<double>().transpose();
  // Gradients as weak as the steps of grey levels tell no place.
  constexpr double kLeastGradient2 = kPixels;
  const double least = products(0, 0) + products(1, 1) -
                       Eigen::Vector2d(products(0, 0) - products(1, 1), 2 * products(0, 1)).norm();
  if (!(least > kLeastGradient2)) return std::nullopt;
  const Eigen::Matrix3f inverse = products.inverse().cast<float>();
  if (!inverse.allFinite() || !(inverse.diagonal().minCoeff() > 0)) return std::nullopt;
  Eigen::Map<Eigen::Vector3f>(patch.mean) = mean.cast<float>();
  int place = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) patch.inverse[place++] = inverse(row, column);
  return patch;
}

Eigen::Matrix2f positionVariance_px2(const AlignPatch& patch, const kernels::AlignResult& found) {
  constexpr float kFreedom = kPixels - 4;  // shift, gain and offset are taken out
  const float level2 = std::max(found.rest, 0.F) / kFreedom;
  Eigen::Matrix2f variance;
  variance << patch.inverse[0], patch.inverse[1], patch.inverse[1], patch.inverse[3];
  return variance * (4 * level2 / (found.gain * found.gain));
}

float explainedShare(const kernels::AlignResult& found) {
  return 1 - std::max(found.rest, 0.F) / found.contrast;
}

}  // namespace ardrone_vslam
