// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ardrone_vslam {

/// How a camera or a stream lays out its pixels.
enum class PixelFormat { kGrey, kUyvy };

inline int bytesPerPixel(PixelFormat format) {
  return format == PixelFormat::kGrey ? 1 : 2;
}

/// Rows of pixels -> grey of the same size, or halved: each pixel the mean of 2 x 2, a half rounded
/// up.
/// @param row_bytes  from one row of `pixels` to the next; the rows of `grey` touch
/// @param width_px,height_px  of `pixels`; even when halved (asserted)
void toGrey(PixelFormat format, const std::uint8_t* pixels, int row_bytes, int width_px,
            int height_px, bool halve, std::uint8_t* grey);

}  // namespace ardrone_vslam
