// SPDX-License-Identifier: BSD-3-Clause
#include "instruction.hpp"

#include <cstddef>

namespace ardrone_vslam::drone {
namespace {

// The first rule that fits counts.
constexpr struct {
  std::uint32_t mask, value;
  Kind kind;
} kRules[] = {
    {0xfe000000, 0xf2000000, Kind::kNeon},          // vectors
    {0xff100000, 0xf4000000, Kind::kNeonMemory},    // VLD1..4, VST1..4
    {0xfe000000, 0xfa000000, Kind::kBranch},        // BLX to Thumb
    {0xf0000000, 0xf0000000, Kind::kOther},         // PLD, barriers
    {0x0fe00e00, 0x0c400a00, Kind::kMove},          // VMOV of two registers to or from the core
    {0x0e000e00, 0x0c000a00, Kind::kScalarMemory},  // VLDR, VSTR, VLDM, VSTM: of vectors as well
    {0x0f000e10, 0x0e000a10, Kind::kMove},          // VMOV and VDUP to or from the core, VMRS
    {0x0fb00e50, 0x0e800a00, Kind::kDivide},        // VDIV
    {0x0fbf0ed0, 0x0eb10ac0, Kind::kDivide},        // VSQRT
    {0x0f000e10, 0x0e000a00, Kind::kScalar},  // the rest of VFP: not pipelined on the Cortex-A8
    {0x0e000000, 0x0a000000, Kind::kBranch},  // B, BL
    {0x0fffffd0, 0x012fff10, Kind::kBranch},  // BX, BLX
    {0x0e000000, 0x04000000, Kind::kMemory},  // LDR, STR
    {0x0e000010, 0x06000000, Kind::kMemory},
    {0x0e000000, 0x08000000, Kind::kMemory},  // LDM, STM, push, pop
    {0x0e0000f0, 0x000000b0, Kind::kMemory},  // of half words, signed bytes, double words
    {0x0e0000d0, 0x000000d0, Kind::kMemory},
    {0x0f8000f0, 0x01800090, Kind::kMemory},  // exclusive
    {0x0c000000, 0x00000000, Kind::kInteger},
    {0x0e000010, 0x06000010, Kind::kInteger},  // USAD8, SXTB, UBFX ...
    {0x00000000, 0x00000000, Kind::kOther},
};

constexpr std::uint32_t bits(std::uint32_t word, int high, int low) {
  return (word >> low) & ((2U << (high - low)) - 1U);
}
constexpr bool bit(std::uint32_t word, int place) {
  return bits(word, place, place) != 0;
}
constexpr std::uint32_t core(std::uint32_t word, int low) {
  return 1U << bits(word, low + 3, low);
}
constexpr std::uint32_t kPc = 1U << 15, kFlagsBit = 1U << Instruction::kFlags;

// `count` registers of 64 bits from the one that the four bits from `low` and the bit `high` name.
constexpr std::uint32_t doubles(std::uint32_t word, int low, int high, unsigned count) {
  const std::uint32_t first = bits(word, low + 3, low) | (bits(word, high, high) << 4U);
  return ((count >= 32 ? 0U : (1U << count)) - 1U) << first;
}

constexpr std::uint32_t kWithoutSource = 0x0d, kWithoutResult = 0x02;  // opcodes 13 and 15; 8 to 11

void decodeInteger(std::uint32_t word, Instruction& to) {
  if (bits(word, 27, 22) == 0 && bits(word, 7, 4) == 9) {  // MUL, MLA
    to.reads_e1 = core(word, 0) | core(word, 8);
    if (bit(word, 21)) to.reads_e2 = core(word, 12);
    to.writes = core(word, 16);
    to.cycles = 2, to.result_stage = 5, to.first_pipe = true;
  } else if (bits(word, 27, 23) == 1 && bits(word, 7, 4) == 9) {  // of 64 bits
    to.reads_e1 = core(word, 0) | core(word, 8);
    if (bit(word, 21)) to.reads_e2 = core(word, 12) | core(word, 16);
    to.writes = core(word, 12) | core(word, 16);
    to.cycles = 3, to.result_stage = 5, to.first_pipe = true;
  } else if (bits(word, 27, 23) == 2 && !bit(word, 20) && bit(word, 7) &&
             !bit(word, 4)) {  // of halves
    to.reads_e1 = core(word, 0) | core(word, 8);
    to.writes = core(word, 16);
    to.result_stage = 5, to.first_pipe = true;
  } else if (bits(word, 27, 25) == 3) {  // SXTB, USAD8, UBFX ...
    to.reads_e1 = core(word, 0);
    if (bits(word, 27, 23) == 0x0d && bits(word, 19, 16) != 15) to.reads_e2 = core(word, 16);
    to.writes = core(word, 12);
  } else if (bits(word, 27, 23) == 6 && bits(word, 21, 20) == 0) {  // MOVW, MOVT
    if (bit(word, 22)) to.reads_e2 = core(word, 12);
    to.writes = core(word, 12);
    to.result_stage = 1;
  } else {
    const std::uint32_t operation = bits(word, 24, 21);
    const bool shifted = !bit(word, 25) && bits(word, 11, 4) != 0;
    if ((operation & kWithoutSource) != kWithoutSource) to.reads_e2 = core(word, 16);
    if (!bit(word, 25)) (shifted ? to.reads_e1 : to.reads_e2) |= core(word, 0);
    if (!bit(word, 25) && bit(word, 4)) to.reads_e1 |= core(word, 8);
    if (operation == 5 || operation == 6 || operation == 7)
      to.reads_e2 |= kFlagsBit;  // with the carry
    if (operation >> 2U != kWithoutResult) to.writes = core(word, 12);
    if (bit(word, 20)) to.writes |= kFlagsBit;
    if (operation == 13 && !shifted) to.result_stage = 1;
  }
}

void decodeMemory(std::uint32_t word, Instruction& to) {
  to.memory = true;
  to.reads_e1 = core(word, 16);
  bool load = bit(word, 20);
  bool writes_back = !bit(word, 24) || bit(word, 21);
  if (bits(word, 27, 25) == 4) {  // LDM, STM
    const std::uint32_t list = bits(word, 15, 0);
    (load ? to.writes : to.reads_e3) = list;
    to.cycles = static_cast<std::uint8_t>((__builtin_popcount(list) + 1) / 2);
    writes_back = bit(word, 21);
  } else if (bits(word, 27, 25) == 0) {
    const bool exclusive = bits(word, 7, 4) == 9;
    const bool two = !exclusive && !load && bits(word, 6, 5) != 1;  // LDRD, STRD
    if (two) load = bits(word, 6, 5) == 2;
    if (!exclusive && !bit(word, 22)) to.reads_e1 |= core(word, 0);
    (load ? to.writes : to.reads_e3) = core(word, 12) * (two ? 3U : 1U);
    if (exclusive) writes_back = false;
  } else {
    if (bit(word, 25)) to.reads_e1 |= core(word, 0);
    (load ? to.writes : to.reads_e3) = core(word, 12);
    // Addresses shifted by anything but two to the left wait a cycle.
    if (bit(word, 25) && bits(word, 11, 4) != 0 && bits(word, 11, 4) != 0x10) to.cycles = 2;
  }
  to.result_stage = 3;
  if (writes_back) to.writes_base = core(word, 16);
  if (load && (to.writes & kPc) != 0) {
    ++to.cycles;
    to.branch = bits(word, 19, 16) == 13 ? Instruction::kReturn : Instruction::kIndirect;
  }
}

void decodeBranch(std::uint32_t word, Instruction& to) {
  if (bits(word, 27, 25) == 5) {
    const bool always = bits(word, 31, 28) >= 14;
    to.branch = bit(word, 24) ? Instruction::kCall
                : always      ? Instruction::kDirect
                              : Instruction::kConditional;
    if (bit(word, 24)) to.writes = 1U << 14U;
    return;
  }
  to.reads_e2 = core(word, 0);
  to.branch = bits(word, 3, 0) == 14 ? Instruction::kReturn : Instruction::kIndirect;
  if (bit(word, 5)) to.branch = Instruction::kCall, to.writes = 1U << 14U;
}

void onNeon(Instruction& to, int cycles, int latency) {
  to.neon_cycles = static_cast<std::uint8_t>(cycles);
  to.neon_latency = static_cast<std::uint8_t>(latency);
}

void decodeThreeSame(std::uint32_t word, unsigned registers, Instruction& to) {
  const std::uint32_t operation = bits(word, 11, 8);
  const bool second = bit(word, 4), quad = registers == 2;
  to.neon_reads = doubles(word, 16, 7, registers) | doubles(word, 0, 5, registers);
  const bool accumulates =
      (operation == 9 && !second) || (operation == 13 && second && !bit(word, 24)) ||
      (operation == 7 && second) || (operation == 1 && second && bit(word, 24));
  if (accumulates) to.neon_reads |= to.neon_writes;
  if (operation == 13 && second) {  // VMLA, VMLS, VMUL of floats
    onNeon(to, quad ? 2 : 1, bit(word, 24) ? 5 : 9);
  } else if (operation >= 13) {  // other floats
    onNeon(to, quad ? 2 : 1, operation == 15 && second ? 9 : 5);
  } else if ((operation == 9 && (second || !bit(word, 24))) || operation == 11) {  // products
    const int cycles = (quad ? 2 : 1) * (bits(word, 21, 20) == 2 ? 2 : 1);
    onNeon(to, cycles, 5 + cycles);
  } else {
    onNeon(to, operation == 4 || operation == 5 ? (quad ? 2 : 1) : 1, 4);
  }
}

void decodeTwoRegisters(std::uint32_t word, unsigned registers, Instruction& to) {
  const std::uint32_t group = bits(word, 17, 16), operation = bits(word, 10, 7);
  to.neon_reads = doubles(word, 0, 5, registers);
  const bool permutes = group == 2 && operation <= 3;  // VSWP, VTRN, VUZP, VZIP
  if (permutes) {
    to.port = Instruction::kNeonLoad;
    to.neon_reads |= to.neon_writes;
    to.neon_writes |= doubles(word, 0, 5, registers);
    onNeon(to, registers == 2 && operation >= 2 ? 3 : static_cast<int>(registers), 2);
  } else if (group == 2 && operation >= 4 && operation <= 6) {  // VMOVN, VQMOVN, VSHLL
    to.neon_reads = doubles(word, 0, 5, operation == 6 ? 1 : 2);
    to.neon_writes = doubles(word, 12, 22, operation == 6 ? 2 : 1);
    onNeon(to, 1, 4);
  } else if (group == 3 && operation >= 8) {  // estimates, conversions
    onNeon(to, static_cast<int>(registers), 5);
  } else {
    const bool accumulates = group == 0 && operation >= 12;  // VPADAL
    if (accumulates) to.neon_reads |= to.neon_writes;
    if (group == 0 && operation <= 2) to.port = Instruction::kNeonLoad;  // VREV
    onNeon(to, 1, accumulates ? 5 : 3);
  }
}

// Long, wide and narrow; or with one element of a register.
void decodeThreeDifferent(std::uint32_t word, Instruction& to) {
  const bool element = bit(word, 6);
  const std::uint32_t operation = bits(word, 11, 8), size = bits(word, 21, 20);
  if (element) {
    const bool into_long = operation < 12 && (operation & 2U) != 0;
    const unsigned registers = !into_long && bit(word, 24) ? 2 : 1;
    const bool accumulates = operation < 8, floats = operation < 10 && (operation & 3U) == 1;
    to.neon_writes = doubles(word, 12, 22, into_long ? 2 : registers);
    to.neon_reads =
        doubles(word, 16, 7, registers) | 1U << (bits(word, 3, 0) & (size == 1 ? 7U : 15U));
    if (accumulates) to.neon_reads |= to.neon_writes;
    onNeon(to, registers == 2 || size == 2 ? 2 : 1, floats ? (accumulates ? 9 : 5) : 7);
    return;
  }
  const bool wide = operation == 1 || operation == 3, narrow = operation == 4 || operation == 6;
  const bool product = operation >= 8, accumulates = operation == 5 || (product && operation < 12);
  to.neon_writes = doubles(word, 12, 22, narrow ? 1 : 2);
  to.neon_reads =
      doubles(word, 16, 7, wide || narrow ? 2 : 1) | doubles(word, 0, 5, narrow ? 2 : 1);
  if (accumulates) to.neon_reads |= to.neon_writes;
  onNeon(to, product && size == 2 ? 2 : 1, product ? 7 : 4);
}

void decodeNeon(std::uint32_t word, Instruction& to) {
  const unsigned registers = bit(word, 6) ? 2 : 1;
  to.port = Instruction::kNeonData;
  to.neon_writes = doubles(word, 12, 22, registers);
  if (!bit(word, 23)) {
    decodeThreeSame(word, registers, to);
  } else if (bit(word, 4)) {  // shifts; without one, a constant
    const bool constant = bits(word, 21, 19) == 0 && !bit(word, 7);
    const std::uint32_t operation = bits(word, 11, 8);
    if (!constant)
      to.neon_reads = doubles(word, 0, 5, operation == 8 || operation == 9 ? 2 : registers);
    if (!constant && operation == 10) to.neon_writes = doubles(word, 12, 22, 2);
    const bool inserts = bit(word, 24) && (operation == 4 || operation == 5);
    if (!constant && (operation == 1 || operation == 3 || inserts)) to.neon_reads |= to.neon_writes;
    onNeon(to, 1, operation >= 14 ? 5 : 4);
  } else if (bits(word, 21, 20) != 3) {
    decodeThreeDifferent(word, to);
  } else if (!bit(word, 24)) {  // VEXT
    to.port = Instruction::kNeonLoad;
    to.neon_reads = doubles(word, 16, 7, registers) | doubles(word, 0, 5, registers);
    onNeon(to, static_cast<int>(registers), 2);
  } else if (!bit(word, 11)) {
    decodeTwoRegisters(word, registers, to);
  } else if (!bit(word, 10)) {  // VTBL, VTBX
    to.port = Instruction::kNeonLoad;
    to.neon_writes = doubles(word, 12, 22, 1);
    to.neon_reads = doubles(word, 16, 7, bits(word, 9, 8) + 1) | doubles(word, 0, 5, 1);
    onNeon(to, bits(word, 9, 8) >= 2 ? 3 : 2, 2);
  } else {  // VDUP
    to.port = Instruction::kNeonLoad;
    to.neon_reads = doubles(word, 0, 5, 1);
    onNeon(to, 1, 2);
  }
}

void decodeNeonMemory(std::uint32_t word, Instruction& to) {
  to.memory = true;
  to.port = Instruction::kNeonLoad;
  to.reads_e1 = core(word, 16);
  if (bits(word, 3, 0) != 15) to.writes_base = core(word, 16);
  if (bits(word, 3, 0) < 13) to.reads_e1 |= core(word, 0);
  unsigned registers = bits(word, 9, 8) + 1;  // of single elements
  int cycles = 2;
  if (!bit(word, 23)) {
    constexpr std::uint8_t kRegisters[16] = {4, 4, 4, 4, 3, 3, 3, 1, 2, 2, 2, 0, 0, 0, 0, 0};
    registers = kRegisters[bits(word, 11, 8)];
    const bool deep =
        bits(word, 11, 8) <= 1 || bits(word, 11, 8) == 4 || bits(word, 11, 8) == 5;  // VLD3, VLD4
    cycles = deep ? 4 : registers > 2 ? 2 : 1;
  }
  (bit(word, 21) ? to.neon_writes : to.neon_reads) = doubles(word, 12, 22, registers);
  onNeon(to, cycles, 1 + cycles);
}

// Of a scalar: a register of 64 bits, or the one that has it as a half.
constexpr std::uint32_t scalar(std::uint32_t word, int low, int high, bool is_double) {
  return is_double ? doubles(word, low, high, 1) : 1U << bits(word, low + 3, low);
}

void decodeScalarMemory(std::uint32_t word, Instruction& to) {
  to.memory = true;
  to.port = Instruction::kNeonLoad;
  to.reads_e1 = core(word, 16);
  const bool is_double = bit(word, 8), multiple = !bit(word, 24) || bit(word, 21);
  const unsigned words = bits(word, 7, 0);
  const unsigned registers = multiple ? (is_double ? words / 2 : (words + 1) / 2) : 1;
  const std::uint32_t named = is_double ? doubles(word, 12, 22, registers)
                                        : ((1U << (registers & 31U)) - 1U) << bits(word, 15, 12);
  (bit(word, 20) ? to.neon_writes : to.neon_reads) = named;
  if (multiple && bit(word, 21)) to.writes_base = core(word, 16);
  to.cycles = static_cast<std::uint8_t>(registers < 2 ? 1 : (registers + 1) / 2);
  onNeon(to, to.cycles, 1 + to.cycles);
}

void decodeMove(std::uint32_t word, Instruction& to) {
  to.port = Instruction::kNeonLoad;
  onNeon(to, 1, 2);
  const bool two = bits(word, 27, 24) == 12;
  const bool vmrs = !two && bits(word, 27, 20) == 0xef && bits(word, 11, 8) == 10;
  to.to_core = bit(word, 20);
  const std::uint32_t of_core = core(word, 12) | (two ? core(word, 16) : 0U);
  const std::uint32_t of_neon =
      two ? scalar(word, 0, 5, bit(word, 8)) : scalar(word, 16, 7, bit(word, 8));
  if (vmrs) {
    to.neon_reads = 0xffffffff;  // what was compared is no register
    to.writes = core(word, 12) == kPc ? kFlagsBit : core(word, 12);
  } else if (to.to_core) {
    to.neon_reads = of_neon;
    to.writes = of_core;
  } else {
    to.reads_e2 = of_core;
    to.neon_writes = of_neon;
  }
}

void decodeScalar(std::uint32_t word, Instruction& to) {
  const bool is_double = bit(word, 8);
  const std::uint32_t operation = (bits(word, 23, 23) << 2U) | bits(word, 21, 20);
  const std::uint32_t result = scalar(word, 12, 22, is_double);
  to.port = Instruction::kNeonData;
  to.vfp = true;
  to.neon_writes = result;
  to.neon_reads = scalar(word, 0, 5, is_double);
  int cycles = 4;  // copies, signs, constants
  if (operation != 7) {
    to.neon_reads |= scalar(word, 16, 7, is_double);
    if (operation <= 1 || operation == 6)
      to.neon_reads |= result, cycles = is_double ? 22 : 20;  // with accumulation
    if (operation == 2) cycles = is_double ? 14 : 11;         // products
    if (operation == 3) cycles = 10;                          // sums
    if (operation == 4) cycles = is_double ? 47 : 29;         // VDIV
  } else if (bit(word, 6)) {
    const std::uint32_t extension = bits(word, 19, 16);
    if (extension == 1 && bit(word, 7)) cycles = is_double ? 45 : 26;  // VSQRT
    if (extension == 4 || extension == 5)
      cycles = 6, to.neon_writes = 0, to.neon_reads |= result;  // VCMP
    if (extension == 7)
      cycles = 6, to.neon_writes = scalar(word, 12, 22, !is_double);  // other precision
    if (extension >= 8) {  // from and to integers, which lie in single registers
      cycles = 9;
      if (extension == 8) to.neon_reads = scalar(word, 0, 5, false);
      if (extension >= 12) to.neon_writes = scalar(word, 12, 22, false);
    }
  } else {
    to.neon_reads = 0;
  }
  onNeon(to, cycles, cycles);
}

}  // namespace

Instruction decode(std::uint32_t word) {
  Instruction result;
  std::size_t rule = 0;
  while ((word & kRules[rule].mask) != kRules[rule].value) ++rule;
  result.kind = kRules[rule].kind;
  switch (result.kind) {
    case Kind::kInteger:
      decodeInteger(word, result);
      break;
    case Kind::kBranch:
      decodeBranch(word, result);
      break;
    case Kind::kMemory:
      decodeMemory(word, result);
      break;
    case Kind::kNeon:
      decodeNeon(word, result);
      break;
    case Kind::kNeonMemory:
      decodeNeonMemory(word, result);
      break;
    case Kind::kScalarMemory:
      decodeScalarMemory(word, result);
      break;
    case Kind::kMove:
      decodeMove(word, result);
      break;
    case Kind::kScalar:
    case Kind::kDivide:
      decodeScalar(word, result);
      break;
    default:
      break;
  }
  const bool conditional = word >> 28U < 14;
  if (conditional && result.kind != Kind::kBranch) result.reads_e2 |= kFlagsBit;
  if (result.branch == Instruction::kNoBranch && result.port == Instruction::kCore &&
      (result.writes & kPc) != 0) {
    result.branch = Instruction::kIndirect;
  }
  return result;
}

}  // namespace ardrone_vslam::drone
