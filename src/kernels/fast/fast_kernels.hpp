// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/fast/fast_circle.hpp"

// The pixel tests of FAST-s on raw pointers (thesis 3.2-3.4). The scalar form is
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

constexpr int kScorePadding = 64;  ///< zeros that must follow each row of scores

/// Where the corners of a row go. Groups are as many columns as a form of the kernels handles at a
/// time, one in the scalar form.
struct FastScores {
  std::uint8_t* scores;   ///< for each column of the row; receives those of the corners. The others
                          ///< must be 0, and stay so
  std::uint16_t* groups;  ///< receives the first columns of groups that together hold all corners,
                          ///< ascending; groups may overlap. Room for x_end - x_begin
};

/// The scores of three rows, and the groups of the middle one that hold corners.
struct FastNeighbours {
  const std::uint8_t* above;
  const std::uint8_t* row;
  const std::uint8_t* below;
  const std::uint16_t* groups;
  int group_count;
  bool later_may_equal;  ///< of equal neighbours the one earlier in raster order is the higher;
                         ///< else neither is
};

constexpr int kMaximaPadding = 4;  ///< entries that may be written after the last maximum

/// @param arc_length_px  s of FAST-s, 9..12
FastCircle fastCircle(std::ptrdiff_t stride_bytes, int arc_length_px);

/// Tests a row's pixels and scores those that are corners.
/// @return the number of groups
int fastRowScalar(const FastRow& row, const FastCircle& circle, const FastScores& out);
int fastRowAvx2(const FastRow& row, const FastCircle& circle, const FastScores& out);
int fastRowNeon(const FastRow& row, const FastCircle& circle, const FastScores& out);

/// Finds the corners whose score is higher than those of their 8 neighbours; pixels of score 0 are
/// no corners.
/// @param columns  receives their columns, ascending; room for all of them and kMaximaPadding
/// @return their number
int fastMaximaScalar(const FastNeighbours& rows, std::uint16_t* columns);
int fastMaximaAvx2(const FastNeighbours& rows, std::uint16_t* columns);
int fastMaximaNeon(const FastNeighbours& rows, std::uint16_t* columns);

/// Lists the corners of a row: the columns of all scores that are not 0.
/// @param groups  as fast_row left them
/// @param columns  as for fastMaximaScalar
/// @return their number
int fastListScalar(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                   std::uint16_t* columns);
int fastListAvx2(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                 std::uint16_t* columns);
int fastListNeon(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                 std::uint16_t* columns);

/// @param threshold  1..255
/// @return whether s circle pixels in a row are all brighter than `centre` + threshold, or all
///   darker than `centre` - threshold (3.1): whether the score is at least `threshold`
bool fastTestScalar(const std::uint8_t* centre, const FastCircle& circle, int threshold);

/// The score V: the largest threshold at which the pixel is still a corner, 0..254; 0 also if it
/// is one at none. It is the largest, over all arcs of s and both polarities, of the least
/// difference in the arc, less 1 (not (3.2)).
int fastScoreScalar(const std::uint8_t* centre, const FastCircle& circle);

}  // namespace ardrone_vslam::kernels
