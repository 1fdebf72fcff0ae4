// SPDX-License-Identifier: BSD-3-Clause
#include "corner_edges.hpp"

#include <cassert>

namespace ardrone_vslam {
namespace {

constexpr int kRadius_px = 3;
constexpr int kSide_px = 2 * kRadius_px + 1;
static_assert(kRadius_px + 1 == kEdgeBorder_px, "the differences reach one pixel further");

}  // namespace

bool liesOnEdge(const ImageView& image, int x_px, int y_px, double ratio) {
  assert(x_px >= kEdgeBorder_px && x_px < image.width_px - kEdgeBorder_px);
  assert(y_px >= kEdgeBorder_px && y_px < image.height_px - kEdgeBorder_px);
  std::int32_t xx = 0;
  std::int32_t yy = 0;
  std::int32_t xy = 0;
  for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
    const std::uint8_t* here = image.row(y_px + dy) + x_px - kRadius_px;
    const std::uint8_t* above = here - image.stride_bytes;
    const std::uint8_t* below = here + image.stride_bytes;
    for (int i = 0; i < kSide_px; ++i) {
      const int gx = here[i + 1] - here[i - 1];
      const int gy = below[i] - above[i];
      xx += gx * gx;
      yy += gy * gy;
      xy += gx * gy;
    }
  }
  // With eigenvalues a <= b: a / b < ratio exactly when ab / (a + b)^2 < ratio / (1 + ratio)^2.
  const double determinant = static_cast<double>(xx) * yy - static_cast<double>(xy) * xy;
  const double trace = static_cast<double>(xx) + yy;
  return determinant * (1 + ratio) * (1 + ratio) < ratio * trace * trace;
}

}  // namespace ardrone_vslam
