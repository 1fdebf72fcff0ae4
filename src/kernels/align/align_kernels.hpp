// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// Alignment of a small patch in an image, with gain and offset of brightness (Lucas and Kanade
// 1981, in the inverse form of Baker and Matthews 2004), on raw pointers. The scalar form is the
// definition: every other form gives the same numbers, bit for bit.
namespace ardrone_vslam::kernels {

constexpr int kPatchSide = 8;    ///< pixels compared, each way
constexpr int kPatchBorder = 1;  ///< around them, for gradients
constexpr int kPatchPixels = kPatchSide * kPatchSide;
constexpr int kPatchRows = kPatchSide + 2 * kPatchBorder;
constexpr int kPatchStride = 16;  ///< bytes of a row, of which kPatchRows count
/// Column and row of the patch's own pixel in `rows`: the patch is compared from 4 pixels before it
/// to 3 behind it.
constexpr int kPatchCentre = kPatchSide / 2 + kPatchBorder;

/// What an image shows around a pixel, and what alignment needs of it.
struct AlignPatch {
  alignas(kPatchStride) std::uint8_t rows[kPatchRows][kPatchStride];
  // Of the compared pixels' gradients (difference of both neighbours) along x and y, and levels:
  float mean[3];
  float inverse[6];  ///< of the 3 x 3 sums of products, means taken out: 11 12 13 22 23 33
};

constexpr int kAlignFarthest_px = 3;  ///< each way, from where the search starts

/// Where a patch was found.
struct AlignResult {
  float x_px = 0;      ///< of the patch's own pixel
  float y_px = 0;      ///< likewise
  float gain = 0;      ///< contrast of the image over the patch's
  float rest = 0;      ///< squared differences that gain and offset leave [grey levels^2], summed
  float contrast = 0;  ///< squared differences from the mean [grey levels^2], of the image, summed
  bool is_found = false;  ///< false: too far, no contrast or no end; then nothing else is told
};

/// The sums, exact, of one comparison: levels of the image times 16.
struct AlignSums {
  std::int32_t gradient_x = 0;  ///< times the patch's gradient
  std::int32_t gradient_y = 0;
  std::int32_t level = 0;  ///< times the patch's level
  std::int32_t one = 0;
  std::int32_t square = 0;
};

/// @param pixels  the image's first pixel
/// @param x_px, y_px  where the search for the patch's own pixel starts, so far inside the image
///   that kAlignFarthest_px further the patch still is
AlignResult alignScalar(const AlignPatch& patch, const std::uint8_t* pixels,
                        std::ptrdiff_t stride_bytes, float x_px, float y_px);
AlignResult alignAvx2(const AlignPatch& patch, const std::uint8_t* pixels,
                      std::ptrdiff_t stride_bytes, float x_px, float y_px);
AlignResult alignNeon(const AlignPatch& patch, const std::uint8_t* pixels,
                      std::ptrdiff_t stride_bytes, float x_px, float y_px);

}  // namespace ardrone_vslam::kernels
