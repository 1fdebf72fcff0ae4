// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include <cstdint>

#include "kernels/fast/fast_lanes.hpp"
#include "kernels/fast/fast_score_lanes.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// 16 pixels; see fast_lanes.hpp.
struct Neon {
  using Bytes = uint8x16_t;
  static constexpr int kLanes = 16;

  static Bytes load(const std::uint8_t* p) { return vld1q_u8(p); }
  static Bytes loadOnce(const std::uint8_t* p) { return vld1q_u8(p); }
  static void store(std::uint8_t* p, Bytes a) { vst1q_u8(p, a); }
  static Bytes broadcast(std::uint32_t four) { return vreinterpretq_u8_u32(vdupq_n_u32(four)); }
  static Bytes add(Bytes a, Bytes b) { return vqaddq_u8(a, b); }
  static Bytes subtract(Bytes a, Bytes b) { return vqsubq_u8(a, b); }
  static Bytes min(Bytes a, Bytes b) { return vminq_u8(a, b); }
  static Bytes max(Bytes a, Bytes b) { return vmaxq_u8(a, b); }
  static Bytes bitOr(Bytes a, Bytes b) { return vorrq_u8(a, b); }
  static Bytes where(Bytes condition, Bytes a) {
    return vandq_u8(vtstq_u8(condition, condition), a);
  }
  static bool any(Bytes a) { return vget_lane_u64(half(a), 0) != 0; }

  /// The drone's Cortex-A8 waits some 20 cycles for a NEON register's content, but not for what
  /// was stored a while ago.
  using Flag = std::uint64_t;
  static constexpr bool kFlagsThroughMemory = true;
  static void storeAny(Bytes a, Flag* flag) { vst1_u64(flag, half(a)); }

  static int append(Bytes a, int x, std::uint16_t* columns, int count) {
    // Four bits for each lane.
    const uint8x8_t narrow = vshrn_n_u16(vreinterpretq_u16_u8(vtstq_u8(a, a)), 4);
    std::uint64_t lanes = vget_lane_u64(vreinterpret_u64_u8(narrow), 0) & 0x1111111111111111U;
    for (; lanes != 0; lanes &= lanes - 1)
      columns[count++] = static_cast<std::uint16_t>(x + __builtin_ctzll(lanes) / 4);
    return count;
  }

 private:
  static uint64x1_t half(Bytes a) {
    return vreinterpret_u64_u8(vorr_u8(vget_low_u8(a), vget_high_u8(a)));
  }
};

}  // namespace

int fastRowNeon(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  return fastRowLanes<Neon>(row, circle, out);
}

int fastMaximaNeon(const FastNeighbours& rows, std::uint16_t* columns) {
  return fastMaximaLanes<Neon>(rows, columns);
}

int fastListNeon(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                 std::uint16_t* columns) {
  return fastListLanes<Neon>(scores, groups, group_count, columns);
}

}  // namespace ardrone_vslam::kernels
