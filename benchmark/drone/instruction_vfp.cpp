// SPDX-License-Identifier: BSD-3-Clause
// Scalar floating point, and what NEON shares with it: its loads and stores, and moves to and from
// the core.
#include "drone/encoding.hpp"

namespace ardrone_vslam::drone {
namespace {

// Operands of a word.
enum : std::uint8_t { kN = 1, kM = 2, kD = 4 };

struct ScalarRule {
  std::uint32_t mask, value;
  std::uint8_t reads;
  std::uint8_t other;  // operands that are not of the word's precision
  std::uint8_t writes;
  std::uint8_t cycles, cycles_of_doubles;
};

constexpr ScalarRule kScalarRules[] = {
    {0x00a00000, 0x00000000, kN | kM | kD, 0, kD, 20, 22},  // VMLA, VMLS, VNMLA, VNMLS
    {0x00b00000, 0x00200000, kN | kM, 0, kD, 11, 14},       // VMUL, VNMUL
    {0x00b00000, 0x00300000, kN | kM, 0, kD, 10, 10},       // VADD, VSUB
    {0x00b00000, 0x00800000, kN | kM, 0, kD, 29, 47},       // VDIV
    {0x00b00040, 0x00b00000, 0, 0, kD, 4, 4},               // VMOV of a constant
    {0x00bf00c0, 0x00b100c0, kM, 0, kD, 26, 45},            // VSQRT
    {0x00be0040, 0x00b40040, kM | kD, 0, 0, 6, 6},          // VCMP
    {0x00bf00c0, 0x00b700c0, kM, kD, kD, 6, 6},             // VCVT to the other precision
    {0x00bf0040, 0x00b80040, kM, kM, kD, 9, 9},  // from integers, which lie in single registers
    {0x00be0040, 0x00bc0040, kM, kD, kD, 9, 9},  // to integers
    {0x00ba0040, 0x00ba0040, kD, 0, kD, 9, 9},   // fixed point, in place
    {0x00000000, 0x00000000, kM, 0, kD, 4, 4},   // VMOV, VABS, VNEG
};

}  // namespace

void decodeScalar(std::uint32_t word, Instruction& to) {
  const ScalarRule& rule = ruleFor(word, kScalarRules);
  const bool is_double = bit(word, 8);
  // Integers are single whatever the word says, and the other precision is the one that it does not
  // say.
  const bool is_conversion = (word & 0x00bf00c0U) == 0x00b700c0U;
  const auto operand = [&](std::uint8_t which, int low, int high) {
    const bool is_other = (rule.other & which) != 0;
    return scalar(word, low, high, is_other ? is_conversion && !is_double : is_double);
  };
  const std::uint32_t d = operand(kD, 12, 22);
  to.port = Instruction::kNeonData;
  to.vfp = true;
  if ((rule.reads & kN) != 0) to.neon_reads |= operand(kN, 16, 7);
  if ((rule.reads & kM) != 0) to.neon_reads |= operand(kM, 0, 5);
  if ((rule.reads & kD) != 0) to.neon_reads |= d;
  if ((rule.writes & kD) != 0) to.neon_writes = d;
  to.neon_cycles = is_double ? rule.cycles_of_doubles : rule.cycles;
  to.neon_latency = to.neon_cycles;
}

void decodeScalarMemory(std::uint32_t word, Instruction& to) {
  const bool is_double = bit(word, 8), is_multiple = !bit(word, 24) || bit(word, 21);
  const unsigned words = is_multiple ? bits(word, 7, 0) : is_double ? 2 : 1;
  const unsigned registers = (words + (is_double ? 0 : 1)) / 2;
  const std::uint32_t named = is_double ? doubles(word, 12, 22, registers)
                                        : ((1U << (registers & 31U)) - 1U) << bits(word, 15, 12);
  to.memory = true;
  to.port = Instruction::kNeonLoad;
  to.reads_e1 = core(word, 16);
  (bit(word, 20) ? to.neon_writes : to.neon_reads) = named;
  if (is_multiple && bit(word, 21)) to.writes_base = core(word, 16);
  to.cycles = static_cast<std::uint8_t>(registers < 2 ? 1 : (registers + 1) / 2);
  to.neon_cycles = to.cycles;
  to.neon_latency = static_cast<std::uint8_t>(1 + to.cycles);
}

void decodeMove(std::uint32_t word, Instruction& to) {
  const bool is_of_two = bits(word, 27, 24) == 12;
  const bool is_vmrs = !is_of_two && bits(word, 27, 20) == 0xef && bits(word, 11, 8) == 10;
  to.port = Instruction::kNeonLoad;
  to.neon_cycles = 1;
  to.neon_latency = 2;
  to.to_core = bit(word, 20);
  if (is_vmrs) {
    to.neon_reads = 0xffffffff;  // what was compared is no register
    to.writes = core(word, 12) == kPc ? kFlagsBit : core(word, 12);
    return;
  }
  const bool is_vdup = !is_of_two && !to.to_core && bit(word, 23);
  if (is_vdup) {
    to.reads_e2 = core(word, 12);
    to.neon_writes = doubles(word, 16, 7, bit(word, 21) ? 2 : 1);
    return;
  }
  const std::uint32_t of_core = core(word, 12) | (is_of_two ? core(word, 16) : 0U);
  const int low = is_of_two ? 0 : 16, high = is_of_two ? 5 : 7;
  (to.to_core ? to.writes : to.reads_e2) = of_core;
  (to.to_core ? to.neon_reads : to.neon_writes) = scalar(word, low, high, bit(word, 8));
}

}  // namespace ardrone_vslam::drone
