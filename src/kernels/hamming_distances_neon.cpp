// SPDX-License-Identifier: BSD-3-Clause
#include <arm_neon.h>

#include "kernels/hamming_distances.hpp"

namespace ardrone_vslam::kernels {
namespace {

inline uint8x16_t load(const std::uint64_t* words) {
  return vreinterpretq_u8_u64(vld1q_u64(words));
}

}  // namespace

void hammingDistancesNeon(const std::uint64_t* query, const std::uint64_t* train, std::size_t count,
                          std::uint16_t* distances_bits) {
  const uint8x16_t q0 = load(query);
  const uint8x16_t q1 = load(query + 2);
  const uint8x16_t q2 = load(query + 4);
  const uint8x16_t q3 = load(query + 6);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t* words = train + 8 * k;
    const uint8x16_t front =
        vaddq_u8(vcntq_u8(veorq_u8(q0, load(words))), vcntq_u8(veorq_u8(q1, load(words + 2))));
    const uint8x16_t back =
        vaddq_u8(vcntq_u8(veorq_u8(q2, load(words + 4))), vcntq_u8(veorq_u8(q3, load(words + 6))));
    const uint64x2_t sums = vpaddlq_u32(vpaddlq_u16(vpaddlq_u8(vaddq_u8(front, back))));
    distances_bits[k] =
        static_cast<std::uint16_t>(vgetq_lane_u64(sums, 0) + vgetq_lane_u64(sums, 1));
  }
}

}  // namespace ardrone_vslam::kernels
