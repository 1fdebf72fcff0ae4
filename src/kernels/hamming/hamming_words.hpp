// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// The Hamming distance on raw words: nothing but <cstdint>, as the kernels need it.
namespace ardrone_vslam::kernels {

/// Carry-save adder: the bits of sum + 2 carry count the set bits of a, b and c at each of 64
/// places.
struct CarrySave {
  std::uint64_t carry;  ///< twos
  std::uint64_t sum;    ///< ones
};
/// Adds three numbers of one bit, 64 times over.
inline CarrySave addBits(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  const std::uint64_t half = a ^ b;
  return {(a & b) | (half & c), half ^ c};
}

/// Number of set bits in each group of four, in that group.
inline std::uint64_t countPerNibble(std::uint64_t x) {
  constexpr std::uint64_t kPairs = 0x5555555555555555U;
  constexpr std::uint64_t kNibbles = 0x3333333333333333U;
  x -= (x >> 1) & kPairs;
  return (x & kNibbles) + ((x >> 2) & kNibbles);
}

/// Sums of neighbouring nibbles, each in a byte.
inline std::uint64_t nibblesToBytes(std::uint64_t x) {
  constexpr std::uint64_t kBytes = 0x0f0f0f0f0f0f0f0fU;
  return (x & kBytes) + ((x >> 4) & kBytes);
}

/// Hamming distance of 512 bits in 8 words each. The adders leave four words to count instead of
/// eight; no popcount instruction is needed, which the base x86-64 and the drone's ARM lack.
inline int hammingDistance512(const std::uint64_t* a, const std::uint64_t* b) {
  const CarrySave p = addBits(a[0] ^ b[0], a[1] ^ b[1], a[2] ^ b[2]);
  const CarrySave q = addBits(p.sum, a[3] ^ b[3], a[4] ^ b[4]);
  const CarrySave r = addBits(q.sum, a[5] ^ b[5], a[6] ^ b[6]);
  const CarrySave twos = addBits(p.carry, q.carry, r.carry);

  // Largest values: 8 and 12 a nibble, 64 a byte, 128 a half word: no carry leaves its group.
  const std::uint64_t ones_count = countPerNibble(r.sum) + countPerNibble(a[7] ^ b[7]);
  const std::uint64_t twos_count = countPerNibble(twos.sum) + 2 * countPerNibble(twos.carry);
  const std::uint64_t bytes = nibblesToBytes(ones_count) + 2 * nibblesToBytes(twos_count);
  constexpr std::uint64_t kHalfWords = 0x00ff00ff00ff00ffU;
  const std::uint64_t half_words = (bytes & kHalfWords) + ((bytes >> 8) & kHalfWords);
  return static_cast<int>((half_words * 0x0001000100010001U) >> 48);
}

}  // namespace ardrone_vslam::kernels
