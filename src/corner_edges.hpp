// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/image_view.hpp"

namespace ardrone_vslam {

/// Least distance of a pixel asked for to the image's border.
constexpr int kEdgeBorder_px = 4;

/// Whether the image around a pixel changes in one direction only, so that a corner found there,
/// where noise or sampling has broken the edge, may lie anywhere along it: the smaller eigenvalue
/// of the structure tensor (Harris and Stephens 1988, central differences, 7x7, no weights) is
/// below `ratio` of the larger one. A flat patch is no edge. Some 250 additions and
/// multiplications of integers.
/// @param ratio  0 to 1; 0: never
bool liesOnEdge(const ImageView& image, int x_px, int y_px, double ratio);

}  // namespace ardrone_vslam
