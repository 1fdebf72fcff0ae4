// SPDX-License-Identifier: BSD-3-Clause
#include "input/grey_conversion.hpp"

#include <cassert>
#include <cstddef>

namespace ardrone_vslam {
namespace {

/// kStep: bytes from one luminance to the next.
template <int kStep>
void copyRow(const std::uint8_t* y, int count, std::uint8_t* grey) {
  for (int i = 0; i < count; ++i) grey[i] = y[kStep * i];
}

template <int kStep>
void halveRow(const std::uint8_t* upper, const std::uint8_t* lower, int count, std::uint8_t* grey) {
  for (int i = 0; i < count; ++i) {
    const int left = 2 * kStep * i;
    const int right = left + kStep;
    grey[i] = static_cast<std::uint8_t>(
        (upper[left] + upper[right] + lower[left] + lower[right] + 2) / 4);
  }
}

template <int kStep>
void convert(const std::uint8_t* luminance, std::ptrdiff_t row_bytes, int width_px, int height_px,
             bool halve, std::uint8_t* grey) {
  if (!halve) {
    for (int y = 0; y < height_px; ++y, luminance += row_bytes, grey += width_px)
      copyRow<kStep>(luminance, width_px, grey);
    return;
  }
  for (int y = 0; y < height_px / 2; ++y, luminance += 2 * row_bytes, grey += width_px / 2)
    halveRow<kStep>(luminance, luminance + row_bytes, width_px / 2, grey);
}

}  // namespace

void toGrey(PixelFormat format, const std::uint8_t* pixels, int row_bytes, int width_px,
            int height_px, bool halve, std::uint8_t* grey) {
  assert((!halve || (width_px % 2 == 0 && height_px % 2 == 0)) && "only even sizes are halved");
  if (format == PixelFormat::kGrey) {
    convert<1>(pixels, row_bytes, width_px, height_px, halve, grey);
  } else {
    convert<2>(pixels + 1, row_bytes, width_px, height_px, halve, grey);  // U Y V Y
  }
}

}  // namespace ardrone_vslam
