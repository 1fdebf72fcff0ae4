// SPDX-License-Identifier: BSD-3-Clause
#include <immintrin.h>

#include <cstdint>

#include "kernels/fast/fast_lanes.hpp"
#include "kernels/fast/fast_score_lanes.hpp"

namespace ardrone_vslam::kernels {
namespace {

/// 32 pixels; see fast_lanes.hpp.
struct Avx2 {
  using Bytes = __m256i;
  static constexpr int kLanes = 32;

  static Bytes load(const std::uint8_t* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  /// For what two instructions use: GCC would load it for each of them.
  static Bytes loadOnce(const std::uint8_t* p) {
    Bytes a = load(p);
    asm("" : "+x"(a));
    return a;
  }
  static void store(std::uint8_t* p, Bytes a) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a);
  }
  static Bytes broadcast(std::uint32_t four) { return _mm256_set1_epi32(static_cast<int>(four)); }
  static Bytes add(Bytes a, Bytes b) { return _mm256_adds_epu8(a, b); }
  static Bytes subtract(Bytes a, Bytes b) { return _mm256_subs_epu8(a, b); }
  static Bytes min(Bytes a, Bytes b) { return _mm256_min_epu8(a, b); }
  static Bytes max(Bytes a, Bytes b) { return _mm256_max_epu8(a, b); }
  static Bytes bitOr(Bytes a, Bytes b) { return _mm256_or_si256(a, b); }
  static Bytes where(Bytes condition, Bytes a) {
    return _mm256_andnot_si256(_mm256_cmpeq_epi8(condition, _mm256_setzero_si256()), a);
  }
  static bool any(Bytes a) { return _mm256_testz_si256(a, a) == 0; }

  using Flag = std::uint8_t;
  static constexpr bool kFlagsThroughMemory = false;
  static void storeAny(Bytes a, Flag* flag) { *flag = any(a) ? 1 : 0; }

  static int append(Bytes a, int x, std::uint16_t* columns, int count) {
    const Bytes zero = _mm256_cmpeq_epi8(a, _mm256_setzero_si256());
    auto lanes = ~static_cast<unsigned>(_mm256_movemask_epi8(zero));
    const int end = count + static_cast<int>(_mm_popcnt_u32(lanes));
    do {
      for (int i = 0; i < 4; ++i) {
        columns[count + i] = static_cast<std::uint16_t>(x + static_cast<int>(_tzcnt_u32(lanes)));
        lanes = _blsr_u32(lanes);
      }
      count += 4;
    } while (lanes != 0);
    return end;
  }
};

}  // namespace

int fastRowAvx2(const FastRow& row, const FastCircle& circle, const FastScores& out) {
  return fastRowLanes<Avx2>(row, circle, out);
}

int fastMaximaAvx2(const FastNeighbours& rows, std::uint16_t* columns) {
  return fastMaximaLanes<Avx2>(rows, columns);
}

int fastListAvx2(const std::uint8_t* scores, const std::uint16_t* groups, int group_count,
                 std::uint16_t* columns) {
  return fastListLanes<Avx2>(scores, groups, group_count, columns);
}

}  // namespace ardrone_vslam::kernels
