// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam {

constexpr int kFreakOrientations = 256;
constexpr int kFreakScales = 64;
constexpr int kFreakPointsPerRing = 6;  // the last ring has one

/// Centre and half side of a field in px, relative to the keypoint. Floats, as the published
/// descriptor rounds here.
struct FreakField {
  float x_px = 0.F;
  float y_px = 0.F;
  float sigma_px = 0.F;
};

/// A field's box in pixels of the image: columns left .. right - 1, rows top .. bottom - 1.
struct FreakPixelBox {
  int left_px, top_px, right_px, bottom_px;
};

/// @return the box of `field` around the pixel (x_px, y_px): the borders centre - sigma and centre
/// + sigma + 1 in float arithmetic, rounded to the nearest integer and halves to the even one.
FreakPixelBox boxAround(const FreakField& field, int x_px, int y_px);

/// FREAK's sampling pattern: 43 fields in rings of 6, 6, 6, 6, 6, 6, 6, 1, turned to 256
/// orientations and enlarged by 2^(k / 16) for the scales k = 0..63. Constant once constructed;
/// about 111 KB, of which a keypoint of the pattern's own size needs 59: the boxes of scale 0 (53
/// KB), the lists of pairs (6 KB). The others are the directions of the ring points (48 KB), from
/// which fields at other scales are computed on the fly.
class FreakPattern {
 public:
  /// A border that lies half way between two pixels is rounded to the even one, so it depends on
  /// whether the keypoint's coordinates are even. Some lie so close to half way that the float
  /// arithmetic decides, at few exceptional coordinates below 2000 px; these fields are in a list.
  /// All other boxes are as the table says everywhere in an image with sides of at most
  /// kLargestSide_px.
  struct IrregularField {
    int index;
    FreakField field;
  };
  static constexpr int kLargestSide_px = 4096;

  FreakPattern();

  /// @return the kFreakPaddedFields boxes of scale 0 for a keypoint there; at exceptional
  /// coordinates those of irregular fields do not hold
  const kernels::FreakBox* boxes(int orientation, int x_px, int y_px) const {
    const std::uint16_t* rows = row_[static_cast<std::size_t>(orientation)].data();
    return rows_[rows[(x_px & 1) + 2 * (y_px & 1)]].data();
  }
  const std::vector<IrregularField>& irregular(int orientation) const {
    return irregular_[static_cast<std::size_t>(orientation)];
  }
  /// @return whether boxes of irregular fields must be recomputed for a keypoint there
  bool isExceptional(int x_px, int y_px) const {
    return exceptional_[static_cast<std::size_t>(x_px)] ||
           exceptional_[static_cast<std::size_t>(y_px)];
  }
  FreakField field(int scale, int orientation, int index) const;

  /// @return the scale for a keypoint of that size; 7 px and less is scale 0.
  static int scaleOf(float size_px);
  /// @return keypoints at x <= border or x >= width - border do not fit; rows alike.
  int border_px(int scale) const { return border_px_[static_cast<std::size_t>(scale)]; }

  const kernels::FreakOrientationPairs& orientationPairs() const { return orientation_pairs_; }
  const kernels::FreakComparisons& comparisons() const { return comparisons_; }

 private:
  struct Direction {
    double cosine, sine;
  };
  /// 6 points of the even rings, then 6 of the odd ones, which are turned by half a step.
  using Directions = std::array<Direction, 12>;

  using Row = std::array<kernels::FreakBox, kernels::kFreakPaddedFields>;

  void computeBoxes(int orientation);
  bool findExceptions(const FreakField& field);
  Row rowOf(int orientation, int x_px, int y_px) const;

  std::array<double, kFreakScales> enlargement_{};
  std::array<int, kFreakScales> border_px_{};
  std::array<Directions, kFreakOrientations> directions_{};
  std::vector<Row> rows_;
  std::array<std::array<std::uint16_t, 4>, kFreakOrientations> row_{};  ///< by evenness of y, x
  std::array<std::vector<IrregularField>, kFreakOrientations> irregular_;
  std::bitset<kLargestSide_px> exceptional_;
  kernels::FreakOrientationPairs orientation_pairs_{};
  kernels::FreakComparisons comparisons_{};
};

}  // namespace ardrone_vslam
