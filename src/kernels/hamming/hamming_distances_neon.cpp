// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/hamming/hamming_distances.hpp"
#include "kernels/hamming/hamming_window_each.hpp"

namespace ardrone_vslam::kernels {
namespace {

inline uint8x16_t load(const std::uint64_t* words) {
  return vreinterpretq_u8_u64(vld1q_u64(words));
}

class Distance {
 public:
  explicit Distance(const std::uint64_t* query)
      : q0_(load(query)), q1_(load(query + 2)), q2_(load(query + 4)), q3_(load(query + 6)) {}

  std::uint16_t operator()(const std::uint64_t* words) const {
    const uint8x16_t front =
        vaddq_u8(vcntq_u8(veorq_u8(q0_, load(words))), vcntq_u8(veorq_u8(q1_, load(words + 2))));
    const uint8x16_t back = vaddq_u8(vcntq_u8(veorq_u8(q2_, load(words + 4))),
                                     vcntq_u8(veorq_u8(q3_, load(words + 6))));
    const uint64x2_t sums = vpaddlq_u32(vpaddlq_u16(vpaddlq_u8(vaddq_u8(front, back))));
    return static_cast<std::uint16_t>(vgetq_lane_u64(sums, 0) + vgetq_lane_u64(sums, 1));
  }

 private:
  uint8x16_t q0_, q1_, q2_, q3_;
};

}  // namespace

void hammingDistancesNeon(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits) {
  const Distance distance(query);
  for (std::size_t k = 0; k < count; ++k) distances_bits[k] = distance(train + 8 * k);
}

void hammingWindowNeon(const HammingWindowEntries& entries, const HammingWindowQuery& query,
                       const HammingRange* ranges, int range_count, HammingNearest& nearest) {
  windowEach(entries, query, ranges, range_count, nearest, Distance(query.words));
}

}  // namespace ardrone_vslam::kernels
