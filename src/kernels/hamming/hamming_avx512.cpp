// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

struct Query {
  explicit Query(const std::uint64_t* query) {
    for (int w = 0; w < kHammingWords; ++w)
      words[w] = _mm512_set1_epi64(static_cast<long long>(query[w]));
  }
  __m512i words[kHammingWords];
};

/// Distances of eight descriptors, in words.
__m128i eightDistances(const Query& query, const std::uint64_t* words) {
  const auto count = [&query, words](int w) {
    return _mm512_popcnt_epi64(
        _mm512_xor_si512(query.words[w], _mm512_loadu_si512(words + w * kHammingGroup)));
  };
  const __m512i a = _mm512_add_epi64(count(0), count(1));
  const __m512i b = _mm512_add_epi64(count(2), count(3));
  const __m512i c = _mm512_add_epi64(count(4), count(5));
  const __m512i d = _mm512_add_epi64(count(6), count(7));
  // (With a mask of all: gcc 12 warns of its own header's unmasked form.)
  return _mm512_maskz_cvtepi64_epi16(
      0xff, _mm512_add_epi64(_mm512_add_epi64(a, b), _mm512_add_epi64(c, d)));
}

/// Two bits for each of 16 words that is greater. Not a mask register: gcc 12 spills its 16 bits
/// and loads 32 of them back.
unsigned maskGreater(__m256i a, __m256i b) {
  return static_cast<unsigned>(_mm256_movemask_epi8(_mm256_cmpgt_epi16(a, b)));
}

/// Enters the query where it is nearer than those before it.
void enter(const HammingMutual& mutual, int first, __m256i distances, __m256i query_number) {
  const __m256i before =
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(mutual.distances_bits + first));
  const __mmask16 nearer = _mm256_cmplt_epu16_mask(distances, before);
  _mm256_mask_storeu_epi16(mutual.distances_bits + first, nearer, distances);
  _mm256_mask_storeu_epi16(mutual.queries + first, nearer, query_number);
}

template <bool kMutual>
void compare(const std::uint64_t* query_words, std::uint16_t query_number, const HammingTile& tile,
             HammingNearest& nearest, const HammingMutual& mutual) {
  const Query query(query_words);
  const __m256i number = _mm256_set1_epi16(static_cast<short>(query_number));
  __m256i limit = _mm256_set1_epi16(static_cast<short>(limitOf(nearest)));
  for (int first = 0; first < tile.count; first += kHammingGroup) {
    const std::uint64_t* words = tile.words + first * kHammingWords;
    const __m256i distances =
        _mm256_set_m128i(eightDistances(query, words + 8), eightDistances(query, words));
    if (kMutual) enter(mutual, first, distances, number);
    const unsigned below = maskGreater(limit, distances);
    if (__builtin_expect(below == 0, 1)) continue;
    alignas(32) std::uint16_t distances_bits[kHammingGroup];
    _mm256_store_si256(reinterpret_cast<__m256i*>(distances_bits), distances);
    offerAll(nearest, tile.first_index + first,
             _pext_u32(below, 0x55555555U) & membersOf(tile, first), distances_bits);
    limit = _mm256_set1_epi16(static_cast<short>(limitOf(nearest)));
  }
}

}  // namespace

void hammingNearestAvx512(const std::uint64_t* query, const HammingTile& tile,
                          HammingNearest& nearest) {
  compare<false>(query, 0, tile, nearest, {});
}

void hammingMutualAvx512(const std::uint64_t* query, std::uint16_t query_number,
                         const HammingTile& tile, HammingNearest& nearest,
                         const HammingMutual& mutual) {
  compare<true>(query, query_number, tile, nearest, mutual);
}

}  // namespace ardrone_vslam::kernels
