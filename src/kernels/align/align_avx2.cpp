// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/align/align_loop.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Two rows of a patch in a vector of 16 numbers; see align_loop.hpp.
class Comparison {
 public:
  explicit Comparison(const AlignPatch& patch) {
    for (int i = 0; i < kVectors; ++i) {
      const int y = 2 * i + kPatchBorder;
      level_[i] = rows(patch, y, kPatchBorder);
      gradient_x_[i] =
          _mm256_sub_epi16(rows(patch, y, kPatchBorder + 1), rows(patch, y, kPatchBorder - 1));
      gradient_y_[i] =
          _mm256_sub_epi16(rows(patch, y + 1, kPatchBorder), rows(patch, y - 1, kPatchBorder));
    }
  }

  AlignSums compare(const std::uint8_t* pixels, std::ptrdiff_t stride_bytes,
                    std::int32_t fraction_x, std::int32_t fraction_y) const {
    const __m128i columns =
        _mm_set1_epi16(static_cast<std::int16_t>((fraction_x << 8) | (kAlignSteps - fraction_x)));
    const __m256i above = weight(kAlignSteps - fraction_y);
    const __m256i below = weight(fraction_y);
    __m128i line = between(pixels, columns);
    __m256i gradient_x = _mm256_setzero_si256();
    __m256i gradient_y = gradient_x;
    __m256i level = gradient_x;
    __m256i one = gradient_x;
    __m256i square = gradient_x;
    for (int i = 0; i < kVectors; ++i) {
      const std::uint8_t* row = pixels + (2 * i + 1) * stride_bytes;
      const __m128i second = between(row, columns);
      const __m128i third = between(row + stride_bytes, columns);
      const __m256i image =
          _mm256_add_epi16(_mm256_mulhrs_epi16(_mm256_set_m128i(second, line), above),
                           _mm256_mulhrs_epi16(_mm256_set_m128i(third, second), below));
      line = third;
      gradient_x = _mm256_add_epi32(gradient_x, _mm256_madd_epi16(image, gradient_x_[i]));
      gradient_y = _mm256_add_epi32(gradient_y, _mm256_madd_epi16(image, gradient_y_[i]));
      level = _mm256_add_epi32(level, _mm256_madd_epi16(image, level_[i]));
      one = _mm256_add_epi16(one, image);
      square = _mm256_add_epi32(square, _mm256_madd_epi16(image, image));
    }
    one = _mm256_madd_epi16(one, _mm256_set1_epi16(1));
    const __m256i four =
        _mm256_hadd_epi32(_mm256_hadd_epi32(gradient_x, gradient_y), _mm256_hadd_epi32(level, one));
    const __m128i sum =
        _mm_add_epi32(_mm256_castsi256_si128(four), _mm256_extracti128_si256(four, 1));
    __m128i squares =
        _mm_add_epi32(_mm256_castsi256_si128(square), _mm256_extracti128_si256(square, 1));
    squares = _mm_hadd_epi32(squares, squares);
    return {_mm_cvtsi128_si32(sum), _mm_extract_epi32(sum, 1), _mm_extract_epi32(sum, 2),
            _mm_extract_epi32(sum, 3), _mm_cvtsi128_si32(squares) + _mm_extract_epi32(squares, 1)};
  }

 private:
  static constexpr int kVectors = kPatchSide / 2;

  static __m128i row(const AlignPatch& patch, int y, int x) {
    return _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&patch.rows[y][x])));
  }
  /// Eight levels of row y, from column x on, and of the row below.
  static __m256i rows(const AlignPatch& patch, int y, int x) {
    return _mm256_set_m128i(row(patch, y + 1, x), row(patch, y, x));
  }
  static __m256i weight(std::int32_t share) {
    return _mm256_set1_epi16(static_cast<std::int16_t>(share * kRowWeight));
  }
  static __m128i between(const std::uint8_t* pixel, __m128i columns) {
    const __m128i left = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixel));
    const __m128i right = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixel + 1));
    return _mm_maddubs_epi16(_mm_unpacklo_epi8(left, right), columns);
  }

  __m256i level_[kVectors];
  __m256i gradient_x_[kVectors];
  __m256i gradient_y_[kVectors];
};

}  // namespace

AlignResult alignAvx2(const AlignPatch& patch, const std::uint8_t* pixels,
                      std::ptrdiff_t stride_bytes, float x_px, float y_px) {
  return alignBy<Comparison>(patch, pixels, stride_bytes, x_px, y_px);
}

}  // namespace ardrone_vslam::kernels
