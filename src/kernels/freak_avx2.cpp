// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/freak_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

__m256i load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

/// Eight bytes' running sums by doubling, in each half of the vector.
__m256i runningSums(__m256i words) {
  words = _mm256_add_epi16(words, _mm256_slli_si256(words, 2));
  words = _mm256_add_epi16(words, _mm256_slli_si256(words, 4));
  return _mm256_add_epi16(words, _mm256_slli_si256(words, 8));
}

/// Entries of 8 pixels in the low half, and of 8 others 16 places further in the high one.
void add16(__m256i sums, const std::uint16_t* above, std::uint16_t* row) {
  const auto* first = reinterpret_cast<const __m128i*>(above);
  const __m256i both = _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(first)),
                                               _mm_loadu_si128(first + 2), 1);
  sums = _mm256_add_epi16(sums, both);
  auto* out = reinterpret_cast<__m128i*>(row);
  _mm_storeu_si128(out, _mm256_castsi256_si128(sums));
  _mm_storeu_si128(out + 2, _mm256_extracti128_si256(sums, 1));
}

/// 32 pixels of a row of the integral image.
/// @param carry  sum of the row's pixels before them, in all words; advanced
void integrate32(__m256i pixels, const std::uint16_t* above, std::uint16_t* row, __m256i& carry) {
  // Sums of pixel pairs halve the work; the sum up to a pair's first pixel lacks its second.
  __m256i odd = runningSums(_mm256_maddubs_epi16(pixels, _mm256_set1_epi8(1)));
  const __m256i total = _mm256_shuffle_epi8(odd, _mm256_set1_epi16(0x0f0e));  // of each half
  const __m256i other = _mm256_permute2x128_si256(total, total, 0x01);
  const __m256i high_half = _mm256_setr_epi64x(0, 0, -1, -1);
  odd = _mm256_add_epi16(odd, _mm256_add_epi16(carry, _mm256_and_si256(other, high_half)));
  carry = _mm256_add_epi16(carry, _mm256_add_epi16(total, other));
  const __m256i even = _mm256_sub_epi16(odd, _mm256_srli_epi16(pixels, 8));
  add16(_mm256_unpacklo_epi16(even, odd), above, row);
  add16(_mm256_unpackhi_epi16(even, odd), above + 8, row + 8);
}

/// The corners of all boxes as places in the integral image, relative to the keypoint: two 32-bit
/// numbers each.
struct Corners {
  alignas(32) std::int64_t plus[kFreakPaddedFields];   ///< left top and right bottom
  alignas(32) std::int64_t minus[kFreakPaddedFields];  ///< right top and left bottom
};

/// Four boxes' borders (left, top, right, bottom) in words.
__m256i fourBoxes(const FreakBox* boxes) {
  return _mm256_cvtepi8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(boxes)));
}

void placeCorners(const FreakBox* boxes, std::ptrdiff_t stride, Corners& corners) {
  const __m256i one_and_stride =
      _mm256_set1_epi32(static_cast<int>((static_cast<std::uint32_t>(stride) << 16) | 1U));
  for (int k = 0; k < kFreakPaddedFields; k += 4) {
    const __m256i borders = fourBoxes(boxes + k);
    const __m256i crossed =  // (right, top, left, bottom)
        _mm256_shufflehi_epi16(_mm256_shufflelo_epi16(borders, 0xc6), 0xc6);
    _mm256_store_si256(reinterpret_cast<__m256i*>(corners.plus + k),
                       _mm256_madd_epi16(borders, one_and_stride));
    _mm256_store_si256(reinterpret_cast<__m256i*>(corners.minus + k),
                       _mm256_madd_epi16(crossed, one_and_stride));
  }
}

/// An entry of the integral image in the low half; above it is the one behind it.
std::uint32_t entry(const std::uint16_t* at_keypoint, std::int64_t place) {
  std::uint32_t value = 0;
  __builtin_memcpy(&value, at_keypoint + place, sizeof value);
  return value;
}

/// The boxes' pixel sums modulo 2^16; above them is anything. Plain loads: gathers are slower.
void boxSums(const std::uint16_t* at_keypoint, const Corners& corners, std::uint32_t* sums) {
#pragma GCC unroll 4
  for (int k = 0; k < kFreakPaddedFields - 4; ++k) {
    const std::int64_t plus = corners.plus[k];
    const std::int64_t minus = corners.minus[k];
    sums[k] = entry(at_keypoint, static_cast<std::int32_t>(plus)) -
              entry(at_keypoint, static_cast<std::int32_t>(minus)) -
              entry(at_keypoint, minus >> 32) + entry(at_keypoint, plus >> 32);
  }
}

/// Four boxes' areas in the low word of each 64-bit lane; above it is anything.
__m256i fourAreas(const FreakBox* boxes) {
  const __m256i borders = fourBoxes(boxes);
  const __m256i sides = _mm256_sub_epi16(_mm256_srli_epi64(borders, 32), borders);
  return _mm256_mullo_epi16(sides, _mm256_srli_epi32(sides, 16));
}

/// Eight fields' means.
__m256i eightMeans(const FreakBox* boxes, const std::uint32_t* sums) {
  const __m256i low_words = _mm256_set1_epi32(0xffff);
  const __m256 mixed = _mm256_shuffle_ps(_mm256_castsi256_ps(fourAreas(boxes)),
                                         _mm256_castsi256_ps(fourAreas(boxes + 4)), 0x88);
  const __m256i areas =
      _mm256_and_si256(_mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8), low_words);
  // (sum + area / 2 + 1 / 2) / area is at least 1 / 512 from every integer; floats err by less
  // than 2^-15 below 256: the integer part is exact.
  const __m256i rounded =
      _mm256_add_epi32(_mm256_and_si256(load(sums), low_words), _mm256_srli_epi32(areas, 1));
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
      third[p] = _mm256_broadcastsi128_si256(
          _mm_loadu_si128(reinterpret_cast<const __m128i*>(means + 16 * p)));
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
  for (int x = 0; x <= image.width_px; ++x) sums[x] = 0;
  const int whole_px = image.width_px / 32 * 32;
  const int rest_px = image.width_px - whole_px;
  alignas(32) std::uint8_t rest[32] = {};
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint8_t* pixels = image.pixels + y * image.stride_bytes;
    const std::uint16_t* above = sums + y * stride + 1;
    std::uint16_t* row = sums + (y + 1) * stride + 1;
    row[-1] = 0;
    __m256i carry = _mm256_setzero_si256();
    for (int x = 0; x < whole_px; x += 32) integrate32(load(pixels + x), above + x, row + x, carry);
    if (rest_px == 0) continue;
    for (int k = 0; k < rest_px; ++k) rest[k] = pixels[whole_px + k];
    integrate32(load(rest), above + whole_px, row + whole_px, carry);
  }
}

void freakMeansAvx2(const std::uint16_t* at_keypoint, std::ptrdiff_t stride, const FreakBox* boxes,
                    std::uint8_t* means) {
  Corners corners;
  placeCorners(boxes, stride, corners);
  alignas(32) std::uint32_t sums[kFreakPaddedFields];
  boxSums(at_keypoint, corners, sums);
  for (int k = kFreakPaddedFields - 4; k < kFreakPaddedFields; ++k) sums[k] = 0;
  __m256i eight[6];
  for (int k = 0; k < 6; ++k) eight[k] = eightMeans(boxes + 8 * k, sums + 8 * k);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(means),
                      packBytes(eight[0], eight[1], eight[2], eight[3]));
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
