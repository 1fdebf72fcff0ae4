// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// The inner loops of FREAK on raw pointers. The scalar form is the definition: every other form
// must give the same bytes. All of it is integer arithmetic.
namespace ardrone_vslam::kernels {

constexpr int kFreakFields = 43;
constexpr int kFreakPaddedFields =
    48;  ///< boxes come in rows of 48: whole vectors; the last field is repeated
constexpr int kFreakOrientationPairs = 45;
constexpr int kFreakComparisons = 512;

/// Borders of a field relative to the keypoint: columns left .. right - 1, rows top .. bottom - 1.
/// At most 256 px.
struct FreakBox {
  std::int8_t left, top, right, bottom;
};

/// One of the 45 pairs that vote for the orientation; weights are 4096 d / |d|^2, d from field j to
/// field i in px.
struct FreakOrientationPair {
  std::uint8_t i, j;
  std::int16_t weight_x, weight_y;
};

/// Grey image, rows `stride_bytes` apart.
struct FreakImage {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride_bytes;
  int width_px, height_px;
};

/// Integral image: (width + 1) x (height + 1) entries, rows `stride` entries apart; the first row
/// and column are 0 and entry (x, y) is the sum of all pixels left of x and above y, modulo 2^16.
/// Differences are exact for sums below 2^16, that is for boxes of up to 257 px.
void freakIntegral16Scalar(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride);
/// The same modulo 2^32, for the larger boxes of enlarged patterns.
void freakIntegral32Scalar(const FreakImage& image, std::uint32_t* sums, std::ptrdiff_t stride);

/// Rounded mean grey of each field: (sum + area / 2) / area.
/// @param at_keypoint  the integral image's entry at the keypoint's column and row
/// @param boxes  kFreakPaddedFields boxes of one orientation
/// @param means  kFreakPaddedFields bytes; those beyond kFreakFields may stay unwritten
void freakMeansScalar(const std::uint16_t* at_keypoint, std::ptrdiff_t stride,
                      const FreakBox* boxes, std::uint8_t* means);

/// Sum over the 45 pairs of (mean_i - mean_j) weight / 2048, each term truncated; sums[0] along x,
/// sums[1] along y.
void freakOrientationScalar(const std::uint8_t* means, const FreakOrientationPair* pairs,
                            std::int32_t* sums);

/// The 512 comparisons mean[first] >= mean[second]. Entry 128 n + 16 q + b of the lists gives bit q
/// of byte b of the n-th 16 bytes.
void freakBitsScalar(const std::uint8_t* means, const std::uint8_t* first,
                     const std::uint8_t* second, std::uint64_t* words);

}  // namespace ardrone_vslam::kernels
