// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/fast_circle.hpp"

// The pixel tests of FAST-s on raw pointers (algorithm.md 1; thesis 3.2-3.4). The scalar form is
// the definition: every other form must give the same hits and scores.
namespace ardrone_vslam::kernels {

/// The pixels of one row that are to be tested. Three rows above and below it must exist.
struct FastRow {
  const std::uint8_t* pixels;      ///< the row's first pixel
  const std::uint8_t* thresholds;  ///< threshold of each column, 1..255 grey levels
  int x_begin_px;  ///< columns x_begin .. x_end - 1, at least 3 from either end of the row
  int x_end_px;
  unsigned columns;  ///< bit k of 0..3: test the columns with x mod 4 == k
};

constexpr int kHitPadding = 4;  ///< entries that may be written after the last

/// Where the corners of a row go.
struct FastHits {
  std::uint16_t* columns;  ///< of the corners, ascending; room for x_end - x_begin + kHitPadding
  std::uint8_t* scores;  ///< for each column of the row; receives those of the corners. The others
                         ///< must be 0, and stay so
};

/// @param arc_length_px  s of FAST-s, 9..12
FastCircle fastCircle(std::ptrdiff_t stride_bytes, int arc_length_px);

/// Tests a row's pixels and scores those that are corners.
/// @return the number of corners
int fastRowScalar(const FastRow& row, const FastCircle& circle, const FastHits& hits);
int fastRowAvx2(const FastRow& row, const FastCircle& circle, const FastHits& hits);
int fastRowNeon(const FastRow& row, const FastCircle& circle, const FastHits& hits);

/// @param threshold  1..255
/// @return whether s circle pixels in a row are all brighter than `centre` + threshold, or all
///   darker than `centre` - threshold (3.1): whether the score is at least `threshold`
bool fastTestScalar(const std::uint8_t* centre, const FastCircle& circle, int threshold);

/// The score V: the largest threshold at which the pixel is still a corner, 0..254; 0 also if it
/// is one at none. It is the largest, over all arcs of s and both polarities, of the least
/// difference in the arc, less 1 (not (3.2)).
int fastScoreScalar(const std::uint8_t* centre, const FastCircle& circle);

}  // namespace ardrone_vslam::kernels
