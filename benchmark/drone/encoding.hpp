// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "drone/instruction.hpp"

// Parts of A32's words, and what decode() calls by an instruction's kind: each follows tables of
// the architecture's manual (ARM DDI 0406C, A5 and A7).
namespace ardrone_vslam::drone {

constexpr std::uint32_t bits(std::uint32_t word, int high, int low) {
  return (word >> low) & ((2U << (high - low)) - 1U);
}
constexpr bool bit(std::uint32_t word, int place) {
  return bits(word, place, place) != 0;
}
/// A register of the core, whose number begins at the bit `low`.
constexpr std::uint32_t core(std::uint32_t word, int low) {
  return 1U << bits(word, low + 3, low);
}
/// `count` registers of 64 bits from the one that the four bits from `low` and the bit `high` name.
constexpr std::uint32_t doubles(std::uint32_t word, int low, int high, unsigned count) {
  const std::uint32_t first = bits(word, low + 3, low) | (bits(word, high, high) << 4U);
  return ((count >= 32 ? 0U : (1U << count)) - 1U) << first;
}
/// Of a scalar: a register of 64 bits, or the one that has it as a half.
constexpr std::uint32_t scalar(std::uint32_t word, int low, int high, bool is_double) {
  return is_double ? doubles(word, low, high, 1) : 1U << bits(word, low + 3, low);
}

/// The first rule of a table that fits; its last one fits all.
template <class Rules>
constexpr const auto& ruleFor(std::uint32_t word, const Rules& rules) {
  const auto* rule = rules;
  while ((word & rule->mask) != rule->value) ++rule;
  return *rule;
}

inline constexpr std::uint32_t kPc = 1U << 15, kLink = 1U << 14,
                               kFlagsBit = 1U << Instruction::kFlags;

void decodeInteger(std::uint32_t word, Instruction& to);
void decodeMemory(std::uint32_t word, Instruction& to);
void decodeBranch(std::uint32_t word, Instruction& to);
void decodeNeon(std::uint32_t word, Instruction& to);
void decodeNeonMemory(std::uint32_t word, Instruction& to);
void decodeScalar(std::uint32_t word, Instruction& to);
void decodeScalarMemory(std::uint32_t word, Instruction& to);
void decodeMove(std::uint32_t word, Instruction& to);

}  // namespace ardrone_vslam::drone
