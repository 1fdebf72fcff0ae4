// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

struct Query {
  explicit Query(const std::uint64_t* query) {
    for (int w = 0; w < kHammingWords; ++w)
      words[w] = _mm256_set1_epi64x(static_cast<long long>(query[w]));
  }
  __m256i words[kHammingWords];
};

__m256i load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

/// Carry-save adder, bit by bit: a + b + c = sum + 2 carry (addBits of hamming_words.hpp).
struct CarrySave {
  CarrySave(__m256i a, __m256i b, __m256i c) {
    const __m256i half = _mm256_xor_si256(a, b);
    carry = _mm256_or_si256(_mm256_and_si256(a, b), _mm256_and_si256(half, c));
    sum = _mm256_xor_si256(half, c);
  }
  __m256i carry, sum;
};

/// kWeight times the number of bits of each byte.
template <int kWeight>
__m256i countBytes(__m256i bits) {
  constexpr char kW = kWeight;
  const __m256i table =
      _mm256_setr_epi8(0, kW, kW, 2 * kW, kW, 2 * kW, 2 * kW, 3 * kW, kW, 2 * kW, 2 * kW, 3 * kW,
                       2 * kW, 3 * kW, 3 * kW, 4 * kW, 0, kW, kW, 2 * kW, kW, 2 * kW, 2 * kW,
                       3 * kW, kW, 2 * kW, 2 * kW, 3 * kW, 2 * kW, 3 * kW, 3 * kW, 4 * kW);
  const __m256i low_nibbles = _mm256_set1_epi8(15);
  const __m256i low = _mm256_and_si256(bits, low_nibbles);
  const __m256i high = _mm256_and_si256(_mm256_srli_epi16(bits, 4), low_nibbles);
  return _mm256_add_epi8(_mm256_shuffle_epi8(table, low), _mm256_shuffle_epi8(table, high));
}

/// Distances of four descriptors, in 64-bit lanes. As hammingDistance512: the adders leave
/// four words to count instead of eight.
__m256i fourDistances(const Query& query, const std::uint64_t* words) {
  const auto differing = [&query, words](int w) {
    return _mm256_xor_si256(query.words[w], load(words + w * kHammingGroup));
  };
  const CarrySave p(differing(0), differing(1), differing(2));
  const CarrySave q(p.sum, differing(3), differing(4));
  const CarrySave r(q.sum, differing(5), differing(6));
  const CarrySave twos(p.carry, q.carry, r.carry);
  const __m256i ones = _mm256_add_epi8(countBytes<1>(r.sum), countBytes<1>(differing(7)));
  const __m256i others = _mm256_add_epi8(countBytes<2>(twos.sum), countBytes<4>(twos.carry));
  return _mm256_sad_epu8(_mm256_add_epi8(ones, others), _mm256_setzero_si256());
}

/// Distances of a group, in words.
__m256i groupDistances(const Query& query, const std::uint64_t* words) {
  const __m256i a = fourDistances(query, words);
  const __m256i b = fourDistances(query, words + 4);
  const __m256i c = fourDistances(query, words + 8);
  const __m256i d = fourDistances(query, words + 12);
  const auto lowHalves = [](__m256i x, __m256i y) {
    return _mm256_castps_si256(
        _mm256_shuffle_ps(_mm256_castsi256_ps(x), _mm256_castsi256_ps(y), 0x88));
  };
  const __m256i mixed = _mm256_packus_epi32(lowHalves(a, b), lowHalves(c, d));
  return _mm256_permutevar8x32_epi32(mixed, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
}

/// Two bits for each of 16 words that is greater.
unsigned maskGreater(__m256i a, __m256i b) {
  return static_cast<unsigned>(_mm256_movemask_epi8(_mm256_cmpgt_epi16(a, b)));
}

void offerGroup(HammingNearest& nearest, const HammingTile& tile, int first, unsigned mask,
                __m256i distances) {
  alignas(32) std::uint16_t distances_bits[kHammingGroup];
  _mm256_store_si256(reinterpret_cast<__m256i*>(distances_bits), distances);
  offerAll(nearest, tile.first_index + first, _pext_u32(mask, 0x55555555U) & membersOf(tile, first),
           distances_bits);
}

/// Enters the query where it is nearer than those before it.
void enter(const HammingMutual& mutual, int first, __m256i distances, __m256i query_number) {
  auto* best = reinterpret_cast<__m256i*>(mutual.distances_bits + first);
  auto* queries = reinterpret_cast<__m256i*>(mutual.queries + first);
  const __m256i before = _mm256_loadu_si256(best);
  const __m256i nearer = _mm256_cmpgt_epi16(before, distances);
  _mm256_storeu_si256(best, _mm256_min_epi16(before, distances));
  _mm256_storeu_si256(queries,
                      _mm256_blendv_epi8(_mm256_loadu_si256(queries), query_number, nearer));
}

template <bool kMutual>
void compare(const std::uint64_t* query_words, std::uint16_t query_number, const HammingTile& tile,
             HammingNearest& nearest, const HammingMutual& mutual) {
  const Query query(query_words);
  const __m256i number = _mm256_set1_epi16(static_cast<short>(query_number));
  __m256i limit = _mm256_set1_epi16(static_cast<short>(limitOf(nearest)));
  for (int first = 0; first < tile.count; first += kHammingGroup) {
    const __m256i distances = groupDistances(query, tile.words + first * kHammingWords);
    if (kMutual) enter(mutual, first, distances, number);
    const unsigned below = maskGreater(limit, distances);
    if (__builtin_expect(below == 0, 1)) continue;
    offerGroup(nearest, tile, first, below, distances);
    limit = _mm256_set1_epi16(static_cast<short>(limitOf(nearest)));
  }
}

}  // namespace

void hammingNearestAvx2(const std::uint64_t* query, const HammingTile& tile,
                        HammingNearest& nearest) {
  compare<false>(query, 0, tile, nearest, {});
}

void hammingMutualAvx2(const std::uint64_t* query, std::uint16_t query_number,
                       const HammingTile& tile, HammingNearest& nearest,
                       const HammingMutual& mutual) {
  compare<true>(query, query_number, tile, nearest, mutual);
}

}  // namespace ardrone_vslam::kernels
