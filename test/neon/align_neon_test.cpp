// SPDX-License-Identifier: BSD-3-Clause
// Cross-compiled for ARM and run under emulation: no test library there.
#include <cstdio>
#include <cstring>

#include "kernels/align/align_kernels.hpp"
#include "support/textured_image.hpp"

namespace ardrone_vslam::test {
namespace {

using kernels::AlignPatch;
using kernels::AlignResult;

/// The patch around a pixel. What comes from its sums need not be exact here.
AlignPatch patchAt(const GreyImage& image, int x_px, int y_px) {
  AlignPatch patch{};
  for (int row = 0; row < kernels::kPatchRows; ++row) {
    for (int column = 0; column < kernels::kPatchRows; ++column)
      patch.rows[row][column] = static_cast<std::uint8_t>(
          image.at(x_px + column - kernels::kPatchCentre, y_px + row - kernels::kPatchCentre));
  }
  double sums[3] = {0, 0, 0};
  double products[3] = {0, 0, 0};
  for (int y = 1; y <= kernels::kPatchSide; ++y) {
    for (int x = 1; x <= kernels::kPatchSide; ++x) {
      const double values[3] = {double(patch.rows[y][x + 1]) - patch.rows[y][x - 1],
                                double(patch.rows[y + 1][x]) - patch.rows[y - 1][x],
                                double(patch.rows[y][x])};
      for (int k = 0; k < 3; ++k) {
        sums[k] += values[k] / 64;
        products[k] += values[k] * values[k];
      }
    }
  }
  for (int k = 0; k < 3; ++k) patch.mean[k] = static_cast<float>(sums[k]);
  const int diagonal[3] = {0, 3, 5};
  for (int k = 0; k < 3; ++k)
    patch.inverse[diagonal[k]] = static_cast<float>(1 / (products[k] - 64 * sums[k] * sums[k] + 1));
  return patch;
}

bool same(const AlignResult& a, const AlignResult& b) {
  return a.is_found == b.is_found && std::memcmp(&a.x_px, &b.x_px, 4) == 0 &&
         std::memcmp(&a.y_px, &b.y_px, 4) == 0 && std::memcmp(&a.gain, &b.gain, 4) == 0 &&
         std::memcmp(&a.rest, &b.rest, 4) == 0 && std::memcmp(&a.contrast, &b.contrast, 4) == 0;
}

}  // namespace

/// @return number of faults
int testAlignNeon() {
  int faults = 0;
  int found_in_all = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    const Texture texture(seed);
    const GreyImage first = texture.image(120, 100, 0, 0);
    const GreyImage second =
        texture.image(120, 100, 0.1 * seed, 0.7 - 0.1 * seed, 0.9, 120, 4, seed);
    for (int i = 0; i < 100; ++i) {
      const int x_px = uniformInt(random, 25, 94);
      const int y_px = uniformInt(random, 25, 74);
      const AlignPatch patch = patchAt(first, x_px, y_px);
      const ImageView view = second.view();
      const auto x_start = static_cast<float>(x_px + uniformInt(random, -64, 64) / 64.0);
      const auto y_start = static_cast<float>(y_px);
      const AlignResult expected =
          kernels::alignScalar(patch, view.data, view.stride_bytes, x_start, y_start);
      const AlignResult found =
          kernels::alignNeon(patch, view.data, view.stride_bytes, x_start, y_start);
      found_in_all += expected.is_found ? 1 : 0;
      if (same(found, expected)) continue;
      std::printf("alignNeon differs from alignScalar: seed %u, patch %d, %d\n", seed, x_px, y_px);
      ++faults;
    }
  }
  if (found_in_all < 300) {
    std::printf("alignNeon: only %d patches were found, the test says nothing\n", found_in_all);
    ++faults;
  }
  return faults;
}

}  // namespace ardrone_vslam::test
