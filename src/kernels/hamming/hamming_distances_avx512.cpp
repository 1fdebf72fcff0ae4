// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_window_lanes.hpp"

namespace ardrone_vslam::kernels {
namespace {

// Masks with all lanes: the plain forms of gcc 12 warn of their own uninitialised values.
inline __m512i shifted(__m512i values, unsigned bits) {
  return _mm512_maskz_slli_epi64(0xff, values, bits);
}

/// A query's distances to four descriptors at a time, one after the other.
class Fours {
 public:
  explicit Fours(const std::uint64_t* query) : query_(_mm512_loadu_si512(query)) {}

  /// @return the distances in the low four lanes of 16 bits
  __m128i operator()(const std::uint64_t* words) const {
    // The sums of four descriptors share the lanes, 16 bits each: at most 512 in the end.
    const __m512i even = _mm512_or_si512(counts(words), shifted(counts(words + 16), 32));
    const __m512i odd = _mm512_or_si512(counts(words + 8), shifted(counts(words + 24), 32));
    const __m512i all = _mm512_or_si512(even, shifted(odd, 16));
    const __m256i half = _mm256_add_epi64(_mm512_maskz_extracti64x4_epi64(0xf, all, 0),
                                          _mm512_maskz_extracti64x4_epi64(0xf, all, 1));
    const __m128i quarter =
        _mm_add_epi64(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
    return _mm_add_epi64(quarter, _mm_unpackhi_epi64(quarter, quarter));
  }

 private:
  __m512i counts(const std::uint64_t* words) const {
    return _mm512_popcnt_epi64(_mm512_xor_si512(query_, _mm512_loadu_si512(words)));
  }
  __m512i query_;
};

}  // namespace

void hammingDistancesAvx512(const std::uint64_t* query, const std::uint64_t* train,
                            std::size_t count, std::uint16_t* distances_bits) {
  const Fours fours(query);
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    _mm_storel_epi64(reinterpret_cast<__m128i*>(distances_bits + k), fours(train + 8 * k));
  if (k < count) hammingDistancesScalar(query, train + 8 * k, count - k, distances_bits + k);
}

void hammingWindowAvx512(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                         const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  const Fours fours(query.words);
  windowLanes(entries, query, ranges, range_count, nearest, [&fours](const std::uint64_t* words) {
    return _mm256_cvtepu16_epi32(_mm_unpacklo_epi64(fours(words), fours(words + 32)));
  });
}

}  // namespace ardrone_vslam::kernels
