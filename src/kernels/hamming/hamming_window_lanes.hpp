// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_window.hpp"

// hammingWindowScalar on eight entries at a time, one in each 32-bit lane of AVX2. Included by the
// files of AVX2 and AVX-512, which differ in how distances are computed; of internal linkage so
// that no code made for one processor can be taken for another's.
namespace ardrone_vslam::kernels {
namespace {

constexpr std::size_t kWindowLanes = kWindowPadding + 1;
constexpr std::int32_t kWindowNothing_bits = 513;  // kNoDistance_bits

inline __m256i lanesAt(const std::int32_t* values) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values));
}

inline std::int32_t leastLane(__m256i lanes) {
  __m128i least = _mm_min_epi32(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1));
  least = _mm_min_epi32(least, _mm_shuffle_epi32(least, 0x4e));
  least = _mm_min_epi32(least, _mm_shuffle_epi32(least, 0xb1));
  return _mm_cvtsi128_si32(least);
}

/// The nearest and the second nearest in each lane.
struct NearestLanes {
  __m256i index, bits, second_bits;

  void offer(__m256i entry, __m256i entry_bits) {
    const __m256i nearer = _mm256_cmpgt_epi32(bits, entry_bits);
    const __m256i before =
        _mm256_and_si256(_mm256_cmpeq_epi32(bits, entry_bits), _mm256_cmpgt_epi32(index, entry));
    second_bits = _mm256_min_epi32(second_bits, _mm256_max_epi32(bits, entry_bits));
    bits = _mm256_min_epi32(bits, entry_bits);
    index = _mm256_blendv_epi8(index, entry, _mm256_or_si256(nearer, before));
  }

  HammingNearest reduce() const {
    const std::int32_t least_bits = leastLane(bits);
    const __m256i none = _mm256_set1_epi32(INT32_MAX);
    const __m256i is_least = _mm256_cmpeq_epi32(bits, _mm256_set1_epi32(least_bits));
    const std::int32_t first = leastLane(_mm256_blendv_epi8(none, index, is_least));
    // What is left when the nearest is taken out of its lane. Indices differ, except of nothing.
    const __m256i is_first = _mm256_cmpeq_epi32(index, _mm256_set1_epi32(first));
    return {first, least_bits, leastLane(_mm256_blendv_epi8(bits, second_bits, is_first))};
  }
};

/// @param eight  takes the words of eight descriptors, one after the other, and gives the query's
///   distances to them in 32-bit lanes
template <class Eight>
void windowLanes(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                 const HammingRange* ranges, int range_count, HammingNearest& nearest,
                 const Eight& eight) {
  const __m256 centre_x_px = _mm256_set1_ps(query.x_px);
  const __m256 centre_y_px = _mm256_set1_ps(query.y_px);
  const __m256 radius2_px2 = _mm256_set1_ps(query.radius2_px2);
  const __m256i number = _mm256_set1_epi32(query.number);
  const __m256i nothing = _mm256_set1_epi32(kWindowNothing_bits);
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  NearestLanes lanes{_mm256_set1_epi32(-1), nothing, nothing};
  for (const HammingRange* range = ranges; range != ranges + range_count; ++range) {
    for (std::size_t k = range->begin; k < range->end; k += kWindowLanes) {
      const std::size_t left = range->end - k;
      const auto count = static_cast<std::int32_t>(left < kWindowLanes ? left : kWindowLanes);
      const __m256 dx_px = _mm256_sub_ps(_mm256_loadu_ps(entries.x_px + k), centre_x_px);
      const __m256 dy_px = _mm256_sub_ps(_mm256_loadu_ps(entries.y_px + k), centre_y_px);
      const __m256 offset2_px2 =
          _mm256_add_ps(_mm256_mul_ps(dx_px, dx_px), _mm256_mul_ps(dy_px, dy_px));
      const __m256i inside =
          _mm256_castps_si256(_mm256_cmp_ps(offset2_px2, radius2_px2, _CMP_LE_OQ));
      const __m256i counts =
          _mm256_and_si256(inside, _mm256_cmpgt_epi32(_mm256_set1_epi32(count), lane));
      if (_mm256_testz_si256(counts, counts) != 0) continue;
      const __m256i bits = _mm256_blendv_epi8(nothing, eight(entries.words + 8 * k), counts);
      lanes.offer(lanesAt(entries.index + k), bits);

      const __m256i known_bits = lanesAt(entries.nearest_query_bits + k);
      const __m256i nearer = _mm256_cmpgt_epi32(known_bits, bits);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(entries.nearest_query_bits + k),
                          _mm256_min_epi32(known_bits, bits));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(entries.nearest_query + k),
                          _mm256_blendv_epi8(lanesAt(entries.nearest_query + k), number, nearer));
    }
  }
  const HammingNearest found = lanes.reduce();
  if (found.distance_bits == kWindowNothing_bits) return;
  // Both hold the two nearest of their own: merged as the second of one is no nearer than its
  // first.
  offer(nearest, found.index, found.distance_bits);
  if (found.second_distance_bits < nearest.second_distance_bits)
    nearest.second_distance_bits = found.second_distance_bits;
}

}  // namespace
}  // namespace ardrone_vslam::kernels
