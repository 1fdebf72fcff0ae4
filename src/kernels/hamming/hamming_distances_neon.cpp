// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_groups.hpp"
#include "kernels/hamming/hamming_window.hpp"

namespace ardrone_vslam::kernels {
namespace {

inline uint8x16_t load(const std::uint64_t* words) {
  return vreinterpretq_u8_u64(vld1q_u64(words));
}

/// A query's distances to four descriptors at a time, one after the other. On the Cortex-A8 each
/// number that goes to the core takes twenty cycles: they stay in vectors.
class Fours {
 public:
  explicit Fours(const std::uint64_t* query)
      : q0_(load(query)), q1_(load(query + 2)), q2_(load(query + 4)), q3_(load(query + 6)) {}

  uint16x4_t operator()(const std::uint64_t* words) const {
    const uint16x4_t first = vpadd_u16(sums(words), sums(words + 8));
    return vpadd_u16(first, vpadd_u16(sums(words + 16), sums(words + 24)));
  }

 private:
  /// Four, of one descriptor.
  uint16x4_t sums(const std::uint64_t* words) const {
    const uint8x16_t front =
        vaddq_u8(vcntq_u8(veorq_u8(q0_, load(words))), vcntq_u8(veorq_u8(q1_, load(words + 2))));
    const uint8x16_t back = vaddq_u8(vcntq_u8(veorq_u8(q2_, load(words + 4))),
                                     vcntq_u8(veorq_u8(q3_, load(words + 6))));
    const uint16x8_t eight = vpaddlq_u8(vaddq_u8(front, back));
    return vadd_u16(vget_low_u16(eight), vget_high_u16(eight));
  }

  uint8x16_t q0_, q1_, q2_, q3_;
};

constexpr std::int32_t kNothing_bits = 513;  // kNoDistance_bits

/// The nearest and the second nearest in each of four lanes.
struct NearestLanes {
  int32x4_t index = vdupq_n_s32(-1);
  int32x4_t bits = vdupq_n_s32(kNothing_bits);
  int32x4_t second_bits = vdupq_n_s32(kNothing_bits);

  void offer(int32x4_t entry, int32x4_t entry_bits) {
    const uint32x4_t before = vandq_u32(vceqq_s32(entry_bits, bits), vcltq_s32(entry, index));
    const uint32x4_t nearer = vorrq_u32(vcltq_s32(entry_bits, bits), before);
    second_bits = vminq_s32(second_bits, vmaxq_s32(bits, entry_bits));
    bits = vminq_s32(bits, entry_bits);
    index = vbslq_s32(nearer, entry, index);
  }

  void mergeInto(HammingNearest& nearest) const {
    std::int32_t indices[4];
    std::int32_t firsts_bits[4];
    std::int32_t seconds_bits[4];
    vst1q_s32(indices, index);
    vst1q_s32(firsts_bits, bits);
    vst1q_s32(seconds_bits, second_bits);
    for (int lane = 0; lane < 4; ++lane) {
      if (firsts_bits[lane] == kNothing_bits) continue;
      kernels::offer(nearest, indices[lane], firsts_bits[lane]);
      if (seconds_bits[lane] < nearest.second_distance_bits)
        nearest.second_distance_bits = seconds_bits[lane];
    }
  }
};

inline bool isAny(uint32x4_t mask) {
  return vget_lane_u32(vreinterpret_u32_u8(vmovn_u16(vcombine_u16(vmovn_u32(mask), vdup_n_u16(0)))),
                       0) != 0;
}

}  // namespace

void hammingDistancesNeon(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits) {
  const Fours fours(query);
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) vst1_u16(distances_bits + k, fours(train + 8 * k));
  if (k < count) hammingDistancesScalar(query, train + 8 * k, count - k, distances_bits + k);
}

void hammingWindowNeon(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                       const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  static const std::int32_t kLane[4] = {0, 1, 2, 3};
  const Fours fours(query.words);
  const int32x4_t lane = vld1q_s32(kLane);
  NearestLanes lanes;
  for (const HammingRange* range = ranges; range != ranges + range_count; ++range) {
    for (std::size_t k = range->begin; k < range->end; k += 4) {
      const float32x4_t dx_px = vsubq_f32(vld1q_f32(entries.x_px + k), vdupq_n_f32(query.x_px));
      const float32x4_t dy_px = vsubq_f32(vld1q_f32(entries.y_px + k), vdupq_n_f32(query.y_px));
      const float32x4_t offset2_px2 = vaddq_f32(vmulq_f32(dx_px, dx_px), vmulq_f32(dy_px, dy_px));
      const std::size_t left = range->end - k;
      const int32x4_t count = vdupq_n_s32(static_cast<std::int32_t>(left < 4 ? left : 4));
      const uint32x4_t counts =
          vandq_u32(vcleq_f32(offset2_px2, vdupq_n_f32(query.radius2_px2)), vcltq_s32(lane, count));
      if (!isAny(counts)) continue;
      const int32x4_t all = vreinterpretq_s32_u32(vmovl_u16(fours(entries.words + 8 * k)));
      const int32x4_t bits = vbslq_s32(counts, all, vdupq_n_s32(kNothing_bits));
      lanes.offer(vld1q_s32(entries.index + k), bits);

      const int32x4_t known_bits = vld1q_s32(entries.nearest_query_bits + k);
      const int32x4_t known = vld1q_s32(entries.nearest_query + k);
      const int32x4_t number = vdupq_n_s32(query.number);
      vst1q_s32(entries.nearest_query + k, vbslq_s32(vcltq_s32(bits, known_bits), number, known));
      vst1q_s32(entries.nearest_query_bits + k, vminq_s32(known_bits, bits));
    }
  }
  lanes.mergeInto(nearest);
}

}  // namespace ardrone_vslam::kernels
