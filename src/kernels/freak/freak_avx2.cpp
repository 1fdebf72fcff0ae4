// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include <algorithm>

#include "kernels/freak/freak_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

__m256i load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

__m128i load128(const void* p) {
  return _mm_loadu_si128(static_cast<const __m128i*>(p));
}

void prefetch(const void* p) {
  _mm_prefetch(static_cast<const char*>(p), _MM_HINT_T0);
}

void store(void* p, __m256i value) {
  _mm256_storeu_si256(static_cast<__m256i*>(p), value);
}

/// Two rows of an image and their entries of the integral image, both from the same column on.
struct TwoRows {
  const std::uint8_t* pixels;
  const std::uint8_t* next_pixels;
  const std::uint16_t* above;
  std::uint16_t* row;
  std::uint16_t* next_row;
};

/// 16 columns of two rows of the integral image. A row in each half: neither waits for the other's
/// running sum, and the entries above are loaded once for both.
/// @param carry  sum of each row's pixels before them, in all words of its half; advanced
inline void integrate16(const TwoRows& at, int x, __m256i& carry) {
  const __m256i pixels = _mm256_setr_m128i(load128(at.pixels + x), load128(at.next_pixels + x));
  // Sums of pixel pairs halve the work; the sum up to a pair's first pixel lacks its second.
  __m256i odd = _mm256_maddubs_epi16(pixels, _mm256_set1_epi8(1));
  // Eight words' running sums by doubling: words 0, 2, .. to the next one, 1 and 5 to the next two,
  // 3 to the next four.
  odd = _mm256_add_epi16(odd, _mm256_slli_epi32(odd, 16));
  const int none = -1;
  odd = _mm256_add_epi16(
      odd, _mm256_shuffle_epi8(odd, _mm256_setr_epi32(none, 0x03020302, none, 0x0b0a0b0a, none,
                                                      0x03020302, none, 0x0b0a0b0a)));
  odd = _mm256_add_epi16(
      odd, _mm256_shuffle_epi8(odd, _mm256_setr_epi32(none, none, 0x07060706, 0x07060706, none,
                                                      none, 0x07060706, 0x07060706)));
  odd = _mm256_add_epi16(odd, carry);
  carry = _mm256_shuffle_epi8(odd, _mm256_set1_epi16(0x0f0e));
  const __m256i even = _mm256_sub_epi16(odd, _mm256_srli_epi16(pixels, 8));
  const __m256i low = _mm256_unpacklo_epi16(even, odd);
  const __m256i high = _mm256_unpackhi_epi16(even, odd);
  const __m256i row =
      _mm256_add_epi16(load(at.above + x), _mm256_permute2x128_si256(low, high, 0x20));
  store(at.row + x, row);
  store(at.next_row + x, _mm256_add_epi16(row, _mm256_permute2x128_si256(low, high, 0x31)));
}

/// The sum of a row's pixels up to a column, from the row's entry and the one above it.
__m128i carryAfter(const std::uint16_t* above, const std::uint16_t* row, int x) {
  return _mm_set1_epi16(static_cast<std::int16_t>(row[x] - above[x]));
}

/// The corners of all boxes as places in the integral image, relative to the keypoint: two 32-bit
/// numbers each.
struct Corners {
  alignas(32) std::int64_t plus[kFreakPaddedFields];   ///< left top and right bottom
  alignas(32) std::int64_t minus[kFreakPaddedFields];  ///< right top and left bottom
};

/// In a function of its own, lest the compiler take them from vector registers one by one instead
/// of from memory.
__attribute__((noinline)) void placeCorners(const FreakBox* boxes, std::ptrdiff_t stride,
                                            Corners& corners) {
  const __m256i one_and_stride =
      _mm256_set1_epi32(static_cast<int>((static_cast<std::uint32_t>(stride) << 16) | 1U));
  const __m256i crossing = _mm256_broadcastsi128_si256(  // (right, top, left, bottom)
      _mm_setr_epi8(4, 5, 2, 3, 0, 1, 6, 7, 12, 13, 10, 11, 8, 9, 14, 15));
  for (int k = 0; k < kFreakPaddedFields; k += 4) {
    const __m256i borders = _mm256_cvtepi8_epi16(load128(boxes + k));
    store(corners.plus + k, _mm256_madd_epi16(borders, one_and_stride));
    store(corners.minus + k,
          _mm256_madd_epi16(_mm256_shuffle_epi8(borders, crossing), one_and_stride));
  }
}

/// Entries of the integral image at one corner of eight boxes and at the opposite one. Inserting
/// them from memory takes fewer steps than adding them in general registers and storing the sums;
/// gathers are slower.
struct EightCorners {
  __m128i near = _mm_setzero_si128();
  __m128i opposite = _mm_setzero_si128();

  template <int kLane>
  void set(const std::uint16_t* at_keypoint, std::int64_t places) {
    near = _mm_insert_epi16(near, at_keypoint[static_cast<std::int32_t>(places)], kLane);
    opposite = _mm_insert_epi16(opposite, at_keypoint[places >> 32], kLane);
  }
  /// @param all  else only the first three
  EightCorners(const std::uint16_t* at_keypoint, const std::int64_t* places, bool all) {
    set<0>(at_keypoint, places[0]);
    set<1>(at_keypoint, places[1]);
    set<2>(at_keypoint, places[2]);
    if (!all) return;
    set<3>(at_keypoint, places[3]);
    set<4>(at_keypoint, places[4]);
    set<5>(at_keypoint, places[5]);
    set<6>(at_keypoint, places[6]);
    set<7>(at_keypoint, places[7]);
  }
  __m128i sum() const { return _mm_add_epi16(near, opposite); }
};

/// Eight boxes' areas.
__m256i eightAreas(const FreakBox* boxes) {
  const __m256i borders = load(boxes);
  const __m256i sides = _mm256_sub_epi8(_mm256_srli_epi32(borders, 16), borders);  // in low words
  const __m256i products = _mm256_maddubs_epi16(sides, _mm256_srli_epi16(sides, 8));
  return _mm256_and_si256(products, _mm256_set1_epi32(0xffff));
}

/// Eight fields' means.
__m256i eightMeans(const FreakBox* boxes, __m128i sums) {
  const __m256i areas = eightAreas(boxes);
  // (sum + area / 2 + 1 / 2) / area is at least 1 / 512 from every integer; floats err by less
  // than 2^-15 below 256: the integer part is exact.
  const __m256i rounded =
      _mm256_add_epi32(_mm256_cvtepu16_epi32(sums), _mm256_srli_epi32(areas, 1));
  const __m256 dividend = _mm256_add_ps(_mm256_cvtepi32_ps(rounded), _mm256_set1_ps(0.5F));
  return _mm256_cvttps_epi32(_mm256_div_ps(dividend, _mm256_cvtepi32_ps(areas)));
}

/// Bytes of 32 numbers below 256.
__m256i packBytes(__m256i a, __m256i b, __m256i c, __m256i d) {
  const __m256i bytes = _mm256_packus_epi16(_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d));
  return _mm256_permutevar8x32_epi32(bytes, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
}

/// The means, each third of them in both halves of a vector, where shuffles find them.
struct MeanTable {
  explicit MeanTable(const std::uint8_t* means) {
    for (int p = 0; p < 3; ++p) {
      third[p] = _mm256_broadcastsi128_si256(load128(means + 16 * p));
    }
  }
  template <int kCount>
  __m256i look(const FreakFieldList<kCount>& list, int entry) const {
    const __m256i a = _mm256_shuffle_epi8(third[0], load(list.part[0] + entry));
    const __m256i b = _mm256_shuffle_epi8(third[1], load(list.part[1] + entry));
    const __m256i c = _mm256_shuffle_epi8(third[2], load(list.part[2] + entry));
    return _mm256_or_si256(_mm256_or_si256(a, b), c);
  }
  __m256i third[3];
};

/// Sum of difference * weight / 2048, each truncated, of 16 pairs, in 8 lanes.
__m256i weighed(__m256i difference, const std::int16_t* weights) {
  // |difference| * 32 * |weight| / 2^16 is the truncated magnitude; the signs come after it.
  const __m256i weight = load(weights);
  const __m256i magnitude = _mm256_mulhi_epu16(_mm256_slli_epi16(_mm256_abs_epi16(difference), 5),
                                               _mm256_abs_epi16(weight));
  const __m256i one = _mm256_set1_epi16(1);
  return _mm256_madd_epi16(_mm256_sign_epi16(magnitude, difference),
                           _mm256_sign_epi16(one, weight));
}

}  // namespace

void freakIntegral16Avx2(const FreakImage& image, std::uint16_t* sums, std::ptrdiff_t stride) {
  constexpr int kStep_px = 16;
  if (image.width_px < kStep_px || image.height_px < 2) {
    freakIntegral16Scalar(image, sums, stride);
    return;
  }
  for (int x = 0; x <= image.width_px; ++x) sums[x] = 0;
  for (int next_y = 0; next_y < image.height_px; next_y += 2) {
    const int y = std::min(next_y, image.height_px - 2);  // the last rows may be done twice
    TwoRows at{};
    at.pixels = image.pixels + y * image.stride_bytes;
    at.next_pixels = at.pixels + image.stride_bytes;
    at.above = sums + y * stride + 1;
    at.row = sums + (y + 1) * stride + 1;
    at.next_row = at.row + stride;
    at.row[-1] = 0;
    at.next_row[-1] = 0;
    __m256i carry = _mm256_setzero_si256();
    int x = 0;
    for (; x + kStep_px <= image.width_px; x += kStep_px) {
      // Two rows at once are no single stream that the processor would fetch ahead by itself.
      prefetch(at.pixels + x + 4 * image.stride_bytes);
      prefetch(at.next_pixels + x + 4 * image.stride_bytes);
      integrate16(at, x, carry);
    }
    if (x == image.width_px) continue;
    x = image.width_px - kStep_px;  // and the last columns
    carry = _mm256_setr_m128i(carryAfter(at.above, at.row, x - 1),
                              carryAfter(at.row, at.next_row, x - 1));
    integrate16(at, x, carry);
  }
}

void freakMeansAvx2(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, const FreakBox* boxes,
                    std::uint8_t* means) {
  Corners corners;
  placeCorners(boxes, stride, corners);
  __m256i eight[6];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const bool all = 8 * (k + 1) <= kFreakFields;
    const EightCorners plus(at_keypoint, corners.plus + 8 * k, all);
    const EightCorners minus(at_keypoint, corners.minus + 8 * k, all);
    eight[k] = eightMeans(boxes + 8 * k, _mm_sub_epi16(plus.sum(), minus.sum()));
  }
  store(means, packBytes(eight[0], eight[1], eight[2], eight[3]));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(means + 32),
                   _mm256_castsi256_si128(packBytes(eight[4], eight[5], eight[4], eight[5])));
}

void freakOrientationAvx2(const std::uint8_t* means, const FreakOrientationPairs& pairs,
                          std::int32_t* sums) {
  const MeanTable table(means);
  __m256i sum_x = _mm256_setzero_si256();
  __m256i sum_y = _mm256_setzero_si256();
  for (int k = 0; k < kFreakOrientationPairs; k += 32) {
    const __m256i i = table.look(pairs.i, k);
    const __m256i j = table.look(pairs.j, k);
    const __m256i low = _mm256_sub_epi16(_mm256_cvtepu8_epi16(_mm256_castsi256_si128(i)),
                                         _mm256_cvtepu8_epi16(_mm256_castsi256_si128(j)));
    const __m256i high = _mm256_sub_epi16(_mm256_cvtepu8_epi16(_mm256_extracti128_si256(i, 1)),
                                          _mm256_cvtepu8_epi16(_mm256_extracti128_si256(j, 1)));
    sum_x = _mm256_add_epi32(sum_x, _mm256_add_epi32(weighed(low, pairs.weight_x + k),
                                                     weighed(high, pairs.weight_x + k + 16)));
    sum_y = _mm256_add_epi32(sum_y, _mm256_add_epi32(weighed(low, pairs.weight_y + k),
                                                     weighed(high, pairs.weight_y + k + 16)));
  }
  const __m256i both = _mm256_hadd_epi32(sum_x, sum_y);  // xx yy xx yy
  __m128i four = _mm_add_epi32(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
  four = _mm_hadd_epi32(four, four);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(sums), four);
}

void freakBitsAvx2(const std::uint8_t* means, const FreakComparisons& lists, std::uint64_t* words) {
  const MeanTable table(means);
  for (int half = 0; half < 64; half += 32) {
    __m256i bits = _mm256_setzero_si256();
    for (int q = 0; q < 8; ++q) {
      const __m256i a = table.look(lists.first, 64 * q + half);
      const __m256i b = table.look(lists.second, 64 * q + half);
      const __m256i not_less = _mm256_cmpeq_epi8(_mm256_max_epu8(a, b), a);
      bits = _mm256_or_si256(
          bits, _mm256_and_si256(not_less, _mm256_set1_epi8(static_cast<char>(1 << q))));
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(words + half / 8), bits);
  }
}

}  // namespace ardrone_vslam::kernels
