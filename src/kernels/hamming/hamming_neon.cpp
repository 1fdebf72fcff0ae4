// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_kernels.hpp"

namespace ardrone_vslam::kernels {
namespace {

struct Query {
  explicit Query(const std::uint64_t* query) {
    for (int w = 0; w < kHammingWords; ++w) words[w] = vreinterpretq_u8_u64(vdupq_n_u64(query[w]));
  }
  uint8x16_t words[kHammingWords];
};

/// Differing bits of two descriptors, eight bytes each of at most 64.
uint8x16_t countTwo(const Query& query, const std::uint64_t* words) {
  uint8x16_t count = vdupq_n_u8(0);
  for (int w = 0; w < kHammingWords; ++w) {
    const uint8x16_t train = vreinterpretq_u8_u64(vld1q_u64(words + w * kHammingGroup));
    count = vaddq_u8(count, vcntq_u8(veorq_u8(train, query.words[w])));
  }
  return count;
}

/// Sums of neighbouring words.
uint16x4_t addNeighbours(uint16x8_t words) {
  return vpadd_u16(vget_low_u16(words), vget_high_u16(words));
}

/// Distances of four descriptors.
uint16x4_t fourDistances(const Query& query, const std::uint64_t* words) {
  const uint16x4_t a = addNeighbours(vpaddlq_u8(countTwo(query, words)));  // two words of each
  const uint16x4_t b = addNeighbours(vpaddlq_u8(countTwo(query, words + 2)));
  return vpadd_u16(a, b);
}

uint16x8_t eightDistances(const Query& query, const std::uint64_t* words) {
  return vcombine_u16(fourDistances(query, words), fourDistances(query, words + 4));
}

/// Bit k is set where a[k] < b[k].
std::uint32_t maskLess(uint16x8_t a, uint16x8_t b) {
  static const std::uint8_t kBits[8] = {1, 2, 4, 8, 16, 32, 64, 128};
  const uint8x8_t bits = vand_u8(vmovn_u16(vcltq_u16(a, b)), vld1_u8(kBits));
  return static_cast<std::uint32_t>(vget_lane_u64(vpaddl_u32(vpaddl_u16(vpaddl_u8(bits))), 0));
}

/// Enters the query where it is nearer than those before it.
void enter(const HammingMutual& mutual, int first, uint16x8_t distances, uint16x8_t query_number) {
  std::uint16_t* best = mutual.distances_bits + first;
  std::uint16_t* queries = mutual.queries + first;
  const uint16x8_t before = vld1q_u16(best);
  vst1q_u16(queries, vbslq_u16(vcltq_u16(distances, before), query_number, vld1q_u16(queries)));
  vst1q_u16(best, vminq_u16(before, distances));
}

template <bool kMutual>
void compare(const std::uint64_t* query_words, std::uint16_t query_number, const HammingTile& tile,
             HammingNearest& nearest, const HammingMutual& mutual) {
  const Query query(query_words);
  const uint16x8_t number = vdupq_n_u16(query_number);
  uint16x8_t limit = vdupq_n_u16(static_cast<std::uint16_t>(limitOf(nearest)));
  for (int first = 0; first < tile.count; first += kHammingGroup) {
    const std::uint64_t* words = tile.words + first * kHammingWords;
    const uint16x8_t low = eightDistances(query, words);
    const uint16x8_t high = eightDistances(query, words + 8);
    if (kMutual) {
      enter(mutual, first, low, number);
      enter(mutual, first + 8, high, number);
    }
    const std::uint32_t below = maskLess(low, limit) | maskLess(high, limit) << 8;
    if (__builtin_expect(below == 0, 1)) continue;
    std::uint16_t distances_bits[kHammingGroup];
    vst1q_u16(distances_bits, low);
    vst1q_u16(distances_bits + 8, high);
    offerAll(nearest, tile.first_index + first, below & membersOf(tile, first), distances_bits);
    limit = vdupq_n_u16(static_cast<std::uint16_t>(limitOf(nearest)));
  }
}

}  // namespace

void hammingNearestNeon(const std::uint64_t* query, const HammingTile& tile,
                        HammingNearest& nearest) {
  compare<false>(query, 0, tile, nearest, {});
}

void hammingMutualNeon(const std::uint64_t* query, std::uint16_t query_number,
                       const HammingTile& tile, HammingNearest& nearest,
                       const HammingMutual& mutual) {
  compare<true>(query, query_number, tile, nearest, mutual);
}

}  // namespace ardrone_vslam::kernels
