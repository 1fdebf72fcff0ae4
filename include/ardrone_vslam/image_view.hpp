// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace ardrone_vslam {

/// A borrowed 8-bit grey image: row y starts at `data + y * stride_bytes`. Owns nothing; the pixels
/// must outlive the view.
struct ImageView {
  const std::uint8_t* data = nullptr;  ///< top left pixel
  int width_px = 0;                    ///< columns
  int height_px = 0;                   ///< rows
  std::ptrdiff_t stride_bytes = 0;     ///< from one row to the next; at least width_px

  /// First pixel of a row, 0 .. height_px - 1 (asserted).
  const std::uint8_t* row(int y_px) const {
    assert(y_px >= 0 && y_px < height_px && "row outside the image");
    return data + y_px * stride_bytes;
  }
  /// Grey level of a pixel of the image (asserted).
  std::uint8_t at(int x_px, int y_px) const {
    assert(x_px >= 0 && x_px < width_px && "column outside the image");
    return row(y_px)[x_px];
  }
  /// Whether there is no pixel.
  bool empty() const { return data == nullptr || width_px <= 0 || height_px <= 0; }
};

}  // namespace ardrone_vslam
