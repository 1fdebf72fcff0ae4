// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "freak_selected_pairs.hpp"
#include "kernels/freak_kernels.hpp"

namespace ardrone_vslam {

constexpr int kFreakOrientations = 256;
constexpr int kFreakScales = 64;

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
/// about 100 KB: the boxes of scale 0 (48 KB), the directions of the ring points from which fields
/// at other scales are computed on the fly (48 KB), the lists of pairs.
class FreakPattern {
 public:
  /// A border that lies half way between two pixels is rounded to the even one, so it depends on
  /// the keypoint's coordinates. Such a field is in this list; all other boxes are the same,
  /// relative to the keypoint, everywhere in an image with sides of at most kLargestSide_px.
  struct IrregularField {
    int index;
    FreakField field;
  };
  static constexpr int kLargestSide_px = 4096;

  FreakPattern();

  /// @return the kFreakPaddedFields boxes of scale 0; those of irregular fields hold for some
  /// keypoints only.
  const kernels::FreakBox* boxes(int orientation) const {
    return boxes_[static_cast<std::size_t>(orientation)].data();
  }
  const std::vector<IrregularField>& irregular(int orientation) const {
    return irregular_[static_cast<std::size_t>(orientation)];
  }
  FreakField field(int scale, int orientation, int index) const;

  /// @return the scale for a keypoint of that size; 7 px and less is scale 0.
  static int scaleOf(float size_px);
  /// @return keypoints at x <= border or x >= width - border do not fit; rows alike.
  int border_px(int scale) const;

  const kernels::FreakOrientationPair* orientationPairs() const {
    return orientation_pairs_.data();
  }
  const std::uint8_t* first() const { return first_.data(); }  ///< kernels::freakBitsScalar's lists
  const std::uint8_t* second() const { return second_.data(); }

 private:
  struct Direction {
    double cosine, sine;
  };
  /// 6 points of the even rings, then 6 of the odd ones, which are turned by half a step.
  using Directions = std::array<Direction, 12>;

  void computeBoxes(int orientation);
  void computeOrientationPairs();
  void computeComparisons();

  std::array<double, kFreakScales> enlargement_{};
  std::array<Directions, kFreakOrientations> directions_{};
  std::array<std::array<kernels::FreakBox, kernels::kFreakPaddedFields>, kFreakOrientations>
      boxes_{};
  std::array<std::vector<IrregularField>, kFreakOrientations> irregular_;
  std::array<kernels::FreakOrientationPair, kernels::kFreakOrientationPairs> orientation_pairs_{};
  std::array<std::uint8_t, kFreakBits> first_{};
  std::array<std::uint8_t, kFreakBits> second_{};
};

}  // namespace ardrone_vslam
