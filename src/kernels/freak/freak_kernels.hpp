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
constexpr int kFreakPaddedPairs = 64;  ///< those beyond 45 weigh nothing
constexpr int kFreakComparisons = 512;

/// Borders of a field relative to the keypoint: columns left .. right - 1, rows top .. bottom - 1.
/// At most 256 px.
struct FreakBox {
  std::int8_t left, top, right, bottom;
};

/// A list of fields to be looked up, also in the form that byte shuffles of 16 take: part[p] says
/// where in means 16 p .. 16 p + 15 the field lies, and is 128, which gives 0, if it is not there.
template <int kCount>
struct FreakFieldList {
  alignas(64) std::uint8_t index[kCount];
  alignas(64) std::uint8_t part[3][kCount];

  void set(int entry, int field) {
    index[entry] = static_cast<std::uint8_t>(field);
    for (int p = 0; p < 3; ++p) {
      part[p][entry] = static_cast<std::uint8_t>(field / 16 == p ? field % 16 : 128);
    }
  }
};

/// The pairs (i, j) that vote for the orientation; weights are 4096 d / |d|^2, d from field j to
/// field i in px. 0.8 KB.
struct FreakOrientationPairs {
  FreakFieldList<kFreakPaddedPairs> i, j;
  alignas(64) std::int16_t weight_x[kFreakPaddedPairs];
  alignas(64) std::int16_t weight_y[kFreakPaddedPairs];
};

/// Entry 64 q + b of the lists gives bit q of byte b of the descriptor. 5 KB.
struct FreakComparisons {
  FreakFieldList<kFreakComparisons> first, second;
  /// The same fields in the order of the descriptor's bits.
  alignas(64) std::uint8_t first_in_order[kFreakComparisons];
  alignas(64) std::uint8_t second_in_order[kFreakComparisons];

  void set(int bit, int byte, int first_field, int second_field) {
    first.set(64 * bit + byte, first_field);
    second.set(64 * bit + byte, second_field);
    first_in_order[8 * byte + bit] = static_cast<std::uint8_t>(first_field);
    second_in_order[8 * byte + bit] = static_cast<std::uint8_t>(second_field);
  }
};

/// Grey image, rows `stride_bytes` apart.
struct FreakImage {
  const std::uint8_t* pixels;
  std::ptrdiff_t stride_bytes;
  int width_px, height_px;
};

/// Entries between the rows of an integral image: room for a row's pixels in whole blocks of 8.
constexpr std::ptrdiff_t freakIntegralStride(int width_px) {
  return (width_px + 7) / 8 * 8 + 1;
}

/// Integral image: (width + 1) x (height + 1) entries, rows `stride` entries apart; the first row
/// and column are 0 and entry (x, y) is the sum of all pixels left of x and above y, modulo 2^16.
/// Differences are exact for sums below 2^16, that is for boxes of up to 257 px.
/// @param sums  height + 1 rows; what lies behind the width + 1 entries of each is undefined
/// @param stride  at least freakIntegralStride(width)
void freakIntegral16Scalar(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride);
/// The same modulo 2^32, for the larger boxes of enlarged patterns.
void freakIntegral32Scalar(const FreakImage& image, std::uint32_t* sums, std::ptrdiff_t stride);

/// Rounded mean grey of each field: (sum + area / 2) / area.
/// @param at_keypoint  the integral image's entry at the keypoint's column and row
/// @param stride  below 2^15
/// @param boxes  kFreakPaddedFields boxes of one orientation
/// @param means  kFreakPaddedFields bytes; those beyond kFreakFields may stay unwritten
void freakMeansScalar(const std::uint16_t* at_keypoint, std::ptrdiff_t stride,
                      const FreakBox* boxes, std::uint8_t* means);

/// Sum over the pairs of (mean_i - mean_j) weight / 2048, each term truncated; sums[0] along x,
/// sums[1] along y.
/// @param means  kFreakPaddedFields bytes
void freakOrientationScalar(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                            std::int32_t* sums);

/// The 512 comparisons mean[first] >= mean[second].
/// @param means  kFreakPaddedFields bytes
/// @param words  8 words
void freakBitsScalar(const std::uint8_t* means, const FreakComparisons& lists,
                     std::uint64_t* words);

// The other forms; only the files of this machine's architecture define theirs.
void freakIntegral16Avx2(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride);
void freakMeansAvx2(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, const FreakBox* boxes,
                    std::uint8_t* means);
void freakOrientationAvx2(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                          std::int32_t* sums);
void freakBitsAvx2(const std::uint8_t* means, const FreakComparisons& lists, std::uint64_t* words);
void freakBitsAvx512(const std::uint8_t* means, const FreakComparisons& lists,
                     std::uint64_t* words);
void freakIntegral16Neon(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride);
void freakMeansNeon(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, const FreakBox* boxes,
                    std::uint8_t* means);
void freakOrientationNeon(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                          std::int32_t* sums);
void freakBitsNeon(const std::uint8_t* means, const FreakComparisons& lists, std::uint64_t* words);

}  // namespace ardrone_vslam::kernels
