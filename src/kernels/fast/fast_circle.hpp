// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// The circle of FAST and the order in which its pixels are tested. Circle pixels count from 0 here:
// pixel n is number n + 1 of the thesis's figure 3.2.
namespace ardrone_vslam::kernels {

constexpr int kCircleSize = 16;
constexpr int kCircleRadiusPx = 3;  ///< pixels closer to the border are never corners

struct CircleOffset {
  std::int8_t x_px, y_px;
};

/// Bresenham circle of radius 3, once around (listing E.1 with its pixel[9] put right: (3, -1)).
constexpr CircleOffset kCircle[kCircleSize] = {
    {-3, 0}, {-3, 1}, {-2, 2}, {-1, 3}, {0, 3},  {1, 3},   {2, 2},   {3, 1},
    {3, 0},  {3, -1}, {2, -2}, {1, -3}, {0, -3}, {-1, -3}, {-2, -2}, {-3, -1}};

/// (3.3): each pixel lies as far as possible from those before it; the first four are the initial
/// test's.
constexpr std::uint8_t kTestOrder[kCircleSize] = {0, 8, 4, 12, 2, 10, 6, 14,
                                                  1, 9, 5, 13, 3, 11, 7, 15};

/// The circle in one image: where its pixels lie in memory, and how many in a row make a corner.
struct FastCircle {
  std::ptrdiff_t offset[kCircleSize];  ///< bytes from the centre, once around
  std::ptrdiff_t stride_bytes;         ///< from row to row
  int arc_length_px;                   ///< s of FAST-s, 9..12
};

/// Tells after each non-conforming pixel whether s conforming ones in a row are still possible
/// (listing 3.2): they are as long as all non-conforming pixels lie in an arc of 16 - s. Exact for
/// s = 9..12: the first non-conforming pixel is the middle of a new numbering, so any other that
/// fits with it is at most 6 away and the seam cannot lie in between.
class NonConformingArc {
 public:
  explicit NonConformingArc(int arc_length_px) : widest_(kCircleSize - 1 - arc_length_px) {}

  /// @param n  a non-conforming circle pixel, 0..15
  /// @return false as soon as no corner is possible any more
  bool add(int n) {
    if (first_ < 0) first_ = n;
    const int step =
        ((n - first_ + kCircleSize / 2) & (kCircleSize - 1)) - kCircleSize / 2;  // -8..7
    if (step < lowest_) lowest_ = step;
    if (step > highest_) highest_ = step;
    return highest_ - lowest_ <= widest_;
  }

 private:
  int widest_;
  int first_ = -1;
  int lowest_ = 0;
  int highest_ = 0;
};

}  // namespace ardrone_vslam::kernels
