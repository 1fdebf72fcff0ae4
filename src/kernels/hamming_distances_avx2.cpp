// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include "kernels/hamming_distances.hpp"

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

}  // namespace

void hammingDistancesAvx2(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits) {
  const BitCounter counter;
  const __m256i first = load(query);
  const __m256i second = load(query + 4);
  const auto counts = [&](const std::uint64_t* words) {
    return counter(_mm256_xor_si256(first, load(words)), _mm256_xor_si256(second, load(words + 4)));
  };
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const std::uint64_t* words = train + 8 * k;
    // The sums of four descriptors share the lanes, 16 bits each: at most 512 in the end.
    const __m256i even = _mm256_or_si256(counts(words), _mm256_slli_epi64(counts(words + 16), 32));
    const __m256i odd =
        _mm256_or_si256(counts(words + 8), _mm256_slli_epi64(counts(words + 24), 32));
    const __m256i all = _mm256_or_si256(even, _mm256_slli_epi64(odd, 16));
    const __m128i half =
        _mm_add_epi64(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(distances_bits + k),
                     _mm_add_epi64(half, _mm_unpackhi_epi64(half, half)));
  }
  if (k < count) hammingDistancesScalar(query, train + 8 * k, count - k, distances_bits + k);
}

}  // namespace ardrone_vslam::kernels
