// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_window_lanes.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// Set bits of each of 64 bytes' halves, summed in four groups of 64 bits.
struct BitCounter {
  __m256i of_nibble = _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4,  //
                                       0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  __m256i low_nibbles = _mm256_set1_epi8(15);

  __m256i perByte(__m256i bits) const {
    const __m256i low = _mm256_and_si256(bits, low_nibbles);
    const __m256i high = _mm256_and_si256(_mm256_srli_epi16(bits, 4), low_nibbles);
    return _mm256_add_epi8(_mm256_shuffle_epi8(of_nibble, low),
                           _mm256_shuffle_epi8(of_nibble, high));
  }
  __m256i operator()(__m256i a, __m256i b) const {
    return _mm256_sad_epu8(_mm256_add_epi8(perByte(a), perByte(b)), _mm256_setzero_si256());
  }
};

inline __m256i load(const std::uint64_t* words) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
}

/// A query's distances to four descriptors at a time, one after the other.
class Fours {
 public:
  explicit Fours(const std::uint64_t* query) : first_(load(query)), second_(load(query + 4)) {}

  /// @return the distances in the low four lanes of 16 bits
  __m128i operator()(const std::uint64_t* words) const {
    // The sums of four descriptors share the lanes, 16 bits each: at most 512 in the end.
    const __m256i even = _mm256_or_si256(counts(words), _mm256_slli_epi64(counts(words + 16), 32));
    const __m256i odd =
        _mm256_or_si256(counts(words + 8), _mm256_slli_epi64(counts(words + 24), 32));
    const __m256i all = _mm256_or_si256(even, _mm256_slli_epi64(odd, 16));
    const __m128i half =
        _mm_add_epi64(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
    return _mm_add_epi64(half, _mm_unpackhi_epi64(half, half));
  }

 private:
  __m256i counts(const std::uint64_t* words) const {
    return counter_(_mm256_xor_si256(first_, load(words)),
                    _mm256_xor_si256(second_, load(words + 4)));
  }
  const BitCounter counter_;
  __m256i first_, second_;
};

}  // namespace

void hammingDistancesAvx2(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits) {
  const Fours fours(query);
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    _mm_storel_epi64(reinterpret_cast<__m128i*>(distances_bits + k), fours(train + 8 * k));
  if (k < count) hammingDistancesScalar(query, train + 8 * k, count - k, distances_bits + k);
}

void hammingWindowAvx2(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                       const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  const Fours fours(query.words);
  windowLanes(entries, query, ranges, range_count, nearest, [&fours](const std::uint64_t* words) {
    return _mm256_cvtepu16_epi32(_mm_unpacklo_epi64(fours(words), fours(words + 32)));
  });
}

}  // namespace ardrone_vslam::kernels
