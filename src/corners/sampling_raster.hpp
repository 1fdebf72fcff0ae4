// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ardrone_vslam {

/// Pixel of each 4x4 block that a sampling pass tests (thesis figure 3.10). The
/// blocks start at the image's pixel (0, 0). Every second row and column is done after 4 passes, a
/// checkerboard after 8, all after 16.
struct RasterOffset {
  int x_px, y_px;
};
constexpr RasterOffset kSamplingRaster[16] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 1}, {3, 3},
                                              {3, 1}, {1, 3}, {1, 0}, {3, 2}, {3, 0}, {1, 2},
                                              {0, 1}, {2, 3}, {2, 1}, {0, 3}};

/// The columns of a row that the first `passes` passes test: bit k stands for x mod 4 == k. All
/// passes of a row are made at once; which pixels are tested does not depend on that, and the row
/// stays in the cache.
inline unsigned sampledColumns(int y_px, int passes) {
  unsigned columns = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const RasterOffset& offset = kSamplingRaster[pass];
    if (offset.y_px == (y_px & 3)) columns |= 1U << offset.x_px;
  }
  return columns;
}

}  // namespace ardrone_vslam
