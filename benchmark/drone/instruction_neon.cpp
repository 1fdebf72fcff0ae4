// SPDX-License-Identifier: BSD-3-Clause
// Vectors.
#include "drone/encoding.hpp"

namespace ardrone_vslam::drone {
namespace {

// How many registers of 64 bits an operand has.
enum Shape : std::uint8_t {
  kNone,
  kOne,
  kTwo,
  kQ,        // two if bit 6 says so
  kS,        // two if bit 24 says so, beside an element
  kElement,  // one, of the lower ones
  kList,     // bits 9 and 8, of a table
};

enum Uses : std::uint8_t {
  kWrites,
  kAdds,
  kSwaps
};  // the result is only written; read, too; and so is m, both ways

struct NeonRule {
  std::uint32_t mask, value;
  Shape d, n, m;
  Uses uses;
  Instruction::Port port;
  std::uint8_t cycles, cycles_of_two, latency;
};

constexpr auto kData = Instruction::kNeonData;
constexpr auto kLoad = Instruction::kNeonLoad;

constexpr NeonRule kNeonRules[] = {
    // Three registers of one length.
    {0x01800f10, 0x00000d10, kQ, kQ, kQ, kAdds, kData, 1, 2, 9},    // VMLA, VMLS of floats
    {0x01800f10, 0x01000d10, kQ, kQ, kQ, kWrites, kData, 1, 2, 5},  // VMUL
    {0x01800f10, 0x00000f10, kQ, kQ, kQ, kWrites, kData, 1, 2, 9},  // VRECPS, VRSQRTS
    {0x00800c00, 0x00000c00, kQ, kQ, kQ, kWrites, kData, 1, 2, 5},  // other floats
    {0x00b00f10, 0x00200900, kQ, kQ, kQ, kAdds, kData, 2, 4, 7},    // VMLA, VMLS of 32 bits
    {0x00800f10, 0x00000900, kQ, kQ, kQ, kAdds, kData, 1, 2, 6},
    {0x00b00f10, 0x00200910, kQ, kQ, kQ, kWrites, kData, 2, 4, 7},  // VMUL
    {0x00800f10, 0x00000910, kQ, kQ, kQ, kWrites, kData, 1, 2, 6},
    {0x00b00f10, 0x00200b00, kQ, kQ, kQ, kWrites, kData, 2, 4, 7},  // VQDMULH
    {0x00800f10, 0x00000b00, kQ, kQ, kQ, kWrites, kData, 1, 2, 6},
    {0x00800f10, 0x00000710, kQ, kQ, kQ, kAdds, kData, 1, 1, 4},    // VABA
    {0x01800f10, 0x01000110, kQ, kQ, kQ, kAdds, kData, 1, 1, 4},    // VBSL, VBIT, VBIF
    {0x00800e00, 0x00000400, kQ, kQ, kQ, kWrites, kData, 1, 2, 4},  // VSHL by a register
    {0x00800000, 0x00000000, kQ, kQ, kQ, kWrites, kData, 1, 1, 4},
    // Shifts by a constant; without one, a constant.
    {0x00b80090, 0x00800010, kQ, kNone, kNone, kWrites, kData, 1, 1, 4},
    {0x00800e10, 0x00800810, kOne, kNone, kTwo, kWrites, kData, 1, 1, 4},  // VSHRN
    {0x00800f10, 0x00800a10, kTwo, kNone, kOne, kWrites, kData, 1, 1, 4},  // VSHLL, VMOVL
    {0x00800e10, 0x00800e10, kQ, kNone, kQ, kWrites, kData, 1, 1, 5},      // VCVT
    {0x00800d10, 0x00800110, kQ, kNone, kQ, kAdds, kData, 1, 1, 4},        // VSRA, VRSRA
    {0x01800e10, 0x01800410, kQ, kNone, kQ, kAdds, kData, 1, 1, 4},        // VSRI, VSLI
    {0x00800010, 0x00800010, kQ, kNone, kQ, kWrites, kData, 1, 1, 4},
    // Permutations and two registers.
    {0x01b00010, 0x00b00000, kQ, kQ, kQ, kWrites, kLoad, 1, 2, 2},  // VEXT
    {0x01b00e10, 0x01b00a00, kOne, kList, kOne, kAdds, kLoad, 3, 3,
     2},  // VTBL, VTBX of three and four
    {0x01b00c10, 0x01b00800, kOne, kList, kOne, kAdds, kLoad, 2, 2, 2},    // of one and two
    {0x01b00f90, 0x01b00c00, kQ, kNone, kOne, kWrites, kLoad, 1, 1, 2},    // VDUP
    {0x01b30f10, 0x01b20000, kQ, kNone, kQ, kSwaps, kLoad, 1, 2, 2},       // VSWP, VTRN
    {0x01b30f10, 0x01b20100, kQ, kNone, kQ, kSwaps, kLoad, 1, 3, 2},       // VUZP, VZIP
    {0x01b30f10, 0x01b20200, kOne, kNone, kTwo, kWrites, kData, 1, 1, 4},  // VMOVN, VQMOVN
    {0x01b30f90, 0x01b20300, kTwo, kNone, kOne, kWrites, kData, 1, 1, 4},  // VSHLL
    {0x01b30c10, 0x01b30400, kQ, kNone, kQ, kWrites, kData, 1, 2, 5},      // VRECPE, VCVT
    {0x01b30f10, 0x01b00000, kQ, kNone, kQ, kWrites, kLoad, 1, 1, 3},      // VREV64, VREV32
    {0x01b30f90, 0x01b00100, kQ, kNone, kQ, kWrites, kLoad, 1, 1, 3},      // VREV16
    {0x01b30f10, 0x01b00600, kQ, kNone, kQ, kAdds, kData, 1, 1, 5},        // VPADAL
    {0x01b00810, 0x01b00000, kQ, kNone, kQ, kWrites, kData, 1, 1, 3},
    // Three registers of different lengths.
    {0x00800d50, 0x00800100, kTwo, kTwo, kOne, kWrites, kData, 1, 1, 4},  // VADDW
    {0x00800d50, 0x00800400, kOne, kTwo, kTwo, kWrites, kData, 1, 1, 4},  // VADDHN
    {0x00800f50, 0x00800500, kTwo, kOne, kOne, kAdds, kData, 1, 1, 4},    // VABAL
    {0x00b00c50, 0x00a00800, kTwo, kOne, kOne, kAdds, kData, 2, 2, 7},    // VMLAL of 32 bits
    {0x00800c50, 0x00800800, kTwo, kOne, kOne, kAdds, kData, 1, 1, 7},
    {0x00b00c50, 0x00a00c00, kTwo, kOne, kOne, kWrites, kData, 2, 2, 7},  // VMULL
    {0x00800c50, 0x00800c00, kTwo, kOne, kOne, kWrites, kData, 1, 1, 7},
    {0x00800050, 0x00800000, kTwo, kOne, kOne, kWrites, kData, 1, 1, 4},  // VADDL
    // With one element of a register.
    {0x00800b50, 0x00800140, kS, kS, kElement, kAdds, kData, 1, 2, 9},      // VMLA, VMLS of floats
    {0x00800f50, 0x00800940, kS, kS, kElement, kWrites, kData, 1, 2, 5},    // VMUL
    {0x00b00a50, 0x00a00240, kTwo, kOne, kElement, kAdds, kData, 2, 2, 7},  // VMLAL of 32 bits
    {0x00800a50, 0x00800240, kTwo, kOne, kElement, kAdds, kData, 1, 1, 7},
    {0x00b00e50, 0x00a00a40, kTwo, kOne, kElement, kWrites, kData, 2, 2, 7},  // VMULL
    {0x00800e50, 0x00800a40, kTwo, kOne, kElement, kWrites, kData, 1, 1, 7},
    {0x00800b50, 0x00800040, kS, kS, kElement, kAdds, kData, 1, 2, 7},  // VMLA, VMLS
    {0x00000000, 0x00000000, kS, kS, kElement, kWrites, kData, 1, 2, 7},
};

unsigned registersOf(Shape shape, std::uint32_t word) {
  switch (shape) {
    case kNone:
      return 0;
    case kTwo:
      return 2;
    case kQ:
      return bit(word, 6) ? 2 : 1;
    case kS:
      return bit(word, 24) ? 2 : 1;
    case kList:
      return bits(word, 9, 8) + 1;
    default:
      return 1;
  }
}

}  // namespace

void decodeNeon(std::uint32_t word, Instruction& to) {
  const NeonRule& rule = ruleFor(word, kNeonRules);
  const unsigned results = registersOf(rule.d, word);
  const bool is_of_halves = bits(word, 21, 20) == 1;
  const std::uint32_t m = rule.m == kElement ? 1U << (bits(word, 3, 0) & (is_of_halves ? 7U : 15U))
                                             : doubles(word, 0, 5, registersOf(rule.m, word));
  to.port = rule.port;
  to.neon_writes = doubles(word, 12, 22, results);
  to.neon_reads = doubles(word, 16, 7, registersOf(rule.n, word)) | m;
  if (rule.uses != kWrites) to.neon_reads |= to.neon_writes;
  if (rule.uses == kSwaps) to.neon_writes |= m;
  to.neon_cycles =
      (rule.d == kQ || rule.d == kS) && results == 2 ? rule.cycles_of_two : rule.cycles;
  to.neon_latency = rule.latency;
}

void decodeNeonMemory(std::uint32_t word, Instruction& to) {
  // Of whole registers, by bits 11 to 8: VLD4 twice, VLD1 of four, VLD2 of four, VLD3 twice, VLD1
  // of three and one ...
  constexpr struct {
    std::uint8_t registers, cycles;
  } kWhole[16] = {{4, 4}, {4, 4}, {4, 2}, {4, 2}, {3, 4}, {3, 4},
                  {3, 2}, {1, 1}, {2, 1}, {2, 1}, {2, 1}};
  const bool is_whole = !bit(word, 23);
  const auto whole = kWhole[bits(word, 11, 8)];
  to.memory = true;
  to.port = Instruction::kNeonLoad;
  to.reads_e1 = core(word, 16);
  if (bits(word, 3, 0) != 15) to.writes_base = core(word, 16);
  if (bits(word, 3, 0) < 13) to.reads_e1 |= core(word, 0);
  const std::uint32_t named =
      doubles(word, 12, 22, is_whole ? whole.registers : bits(word, 9, 8) + 1);
  (bit(word, 21) ? to.neon_writes : to.neon_reads) = named;
  to.neon_cycles = is_whole ? whole.cycles : std::uint8_t{2};
  to.neon_latency = static_cast<std::uint8_t>(1 + to.neon_cycles);
}

}  // namespace ardrone_vslam::drone
