// SPDX-License-Identifier: BSD-3-Clause
// Integers, memory and branches.
#include "drone/encoding.hpp"

namespace ardrone_vslam::drone {
namespace {

void decodeMultiplication(std::uint32_t word, Instruction& to) {
  const bool is_long = bit(word, 23), accumulates = bit(word, 21);
  to.reads_e1 = core(word, 0) | core(word, 8);
  to.writes = core(word, 16) | (is_long ? core(word, 12) : 0U);
  if (accumulates) to.reads_e2 = core(word, 12) | (is_long ? core(word, 16) : 0U);
  to.cycles = is_long ? 3 : 2;
}

// SXTB, USAD8, UBFX ...; SXTAB and its like add.
void decodeMedia(std::uint32_t word, Instruction& to) {
  to.reads_e1 = core(word, 0);
  if (bits(word, 27, 23) == 0x0d && bits(word, 19, 16) != 15) to.reads_e2 = core(word, 16);
  to.writes = core(word, 12);
}

// MOVW, MOVT.
void decodeWideMove(std::uint32_t word, Instruction& to) {
  if (bit(word, 22)) to.reads_e2 = core(word, 12);
  to.writes = core(word, 12);
  to.result_stage = 1;
}

// The second operand: a constant, a register, or a shifted one, which is needed earlier.
void readOperand(std::uint32_t word, Instruction& to) {
  if (bit(word, 25)) return;
  const bool is_shifted = bits(word, 11, 4) != 0;
  (is_shifted ? to.reads_e1 : to.reads_e2) |= core(word, 0);
  if (bit(word, 4)) to.reads_e1 |= core(word, 8);
}

void decodeDataProcessing(std::uint32_t word, Instruction& to) {
  enum : std::uint32_t { kAdc = 5, kRsc = 7, kTst = 8, kCmn = 11, kMov = 13, kMvn = 15 };
  const std::uint32_t operation = bits(word, 24, 21);
  readOperand(word, to);
  if (operation != kMov && operation != kMvn) to.reads_e2 |= core(word, 16);
  if (operation >= kAdc && operation <= kRsc) to.reads_e2 |= kFlagsBit;
  if (operation < kTst || operation > kCmn) to.writes = core(word, 12);
  if (bit(word, 20)) to.writes |= kFlagsBit;
  if (operation == kMov && to.reads_e1 == 0) to.result_stage = 1;
}

void decodeMultiple(std::uint32_t word, Instruction& to) {
  const std::uint32_t list = bits(word, 15, 0);
  (bit(word, 20) ? to.writes : to.reads_e3) = list;
  to.cycles = static_cast<std::uint8_t>((__builtin_popcount(list) + 1) / 2);
  if (bit(word, 21)) to.writes_base = core(word, 16);
}

void decodeExclusive(std::uint32_t word, Instruction& to) {
  (bit(word, 20) ? to.writes : to.reads_e3) = core(word, 12);
}

// Before or after the access the address is changed.
void writeBack(std::uint32_t word, Instruction& to) {
  if (!bit(word, 24) || bit(word, 21)) to.writes_base = core(word, 16);
}

// Half words, signed bytes, and two registers.
void decodeExtra(std::uint32_t word, Instruction& to) {
  const bool is_two = !bit(word, 20) && bits(word, 6, 5) != 1;  // LDRD, STRD
  const bool loads = is_two ? bits(word, 6, 5) == 2 : bit(word, 20);
  if (!bit(word, 22)) to.reads_e1 |= core(word, 0);
  (loads ? to.writes : to.reads_e3) = core(word, 12) * (is_two ? 3U : 1U);
  writeBack(word, to);
}

void decodeSingle(std::uint32_t word, Instruction& to) {
  constexpr std::uint32_t kByFour = 0x10;  // shifted by two to the left
  (bit(word, 20) ? to.writes : to.reads_e3) = core(word, 12);
  writeBack(word, to);
  if (!bit(word, 25)) return;
  to.reads_e1 |= core(word, 0);
  if (bits(word, 11, 4) != 0 && bits(word, 11, 4) != kByFour) to.cycles = 2;
}

}  // namespace

void decodeInteger(std::uint32_t word, Instruction& to) {
  const bool multiplies = bits(word, 27, 24) == 0 && bits(word, 7, 4) == 9;
  const bool multiplies_halves = (word & 0x0f900090U) == 0x01000080U;
  if (multiplies) {
    decodeMultiplication(word, to);
  } else if (multiplies_halves) {
    to.reads_e1 = core(word, 0) | core(word, 8);
    to.writes = core(word, 16);
  } else if (bits(word, 27, 25) == 3) {
    decodeMedia(word, to);
  } else if ((word & 0x0fb00000U) == 0x03000000U) {
    decodeWideMove(word, to);
  } else {
    decodeDataProcessing(word, to);
  }
  if (!multiplies && !multiplies_halves) return;
  to.result_stage = 5;
  to.first_pipe = true;
}

void decodeMemory(std::uint32_t word, Instruction& to) {
  to.memory = true;
  to.reads_e1 = core(word, 16);
  to.result_stage = 3;
  if (bits(word, 27, 25) == 4)
    decodeMultiple(word, to);
  else if (bits(word, 27, 25) != 0)
    decodeSingle(word, to);
  else if (bits(word, 7, 4) == 9)
    decodeExclusive(word, to);
  else
    decodeExtra(word, to);
  if ((to.writes & kPc) == 0) return;
  ++to.cycles;
  to.branch = bits(word, 19, 16) == 13 ? Instruction::kReturn : Instruction::kIndirect;
}

void decodeBranch(std::uint32_t word, Instruction& to) {
  const bool is_relative = bits(word, 27, 25) == 5;
  const bool calls = is_relative ? bit(word, 24) || word >> 28U == 15 : bit(word, 5);
  if (!is_relative) to.reads_e2 = core(word, 0);
  if (calls) {
    to.branch = Instruction::kCall;
    to.writes = kLink;
  } else if (is_relative) {
    to.branch = word >> 28U == 14 ? Instruction::kDirect : Instruction::kConditional;
  } else {
    to.branch = bits(word, 3, 0) == 14 ? Instruction::kReturn : Instruction::kIndirect;
  }
}

}  // namespace ardrone_vslam::drone
