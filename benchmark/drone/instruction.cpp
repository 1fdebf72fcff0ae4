// SPDX-License-Identifier: BSD-3-Clause
#include "drone/instruction.hpp"

#include "drone/encoding.hpp"

namespace ardrone_vslam::drone {
namespace {

struct KindRule {
  std::uint32_t mask, value;
  Kind kind;
  void (*decode)(std::uint32_t word, Instruction& to);  // nullptr: nothing is waited for
};

constexpr KindRule kKinds[] = {
    {0xfe000000, 0xf2000000, Kind::kNeon, decodeNeon},              // vectors
    {0xff100000, 0xf4000000, Kind::kNeonMemory, decodeNeonMemory},  // VLD1..4, VST1..4
    {0xfe000000, 0xfa000000, Kind::kBranch, decodeBranch},          // BLX to Thumb
    {0xf0000000, 0xf0000000, Kind::kOther, nullptr},                // PLD, barriers
    {0x0fe00e00, 0x0c400a00, Kind::kMove, decodeMove},  // VMOV of two registers to or from the core
    {0x0e000e00, 0x0c000a00, Kind::kScalarMemory,
     decodeScalarMemory},  // VLDR, VSTR, VLDM, VSTM: of vectors as well
    {0x0f000e10, 0x0e000a10, Kind::kMove, decodeMove},  // VMOV and VDUP to or from the core, VMRS
    {0x0fb00e50, 0x0e800a00, Kind::kDivide, decodeScalar},  // VDIV
    {0x0fbf0ed0, 0x0eb10ac0, Kind::kDivide, decodeScalar},  // VSQRT
    {0x0f000e10, 0x0e000a00, Kind::kScalar, decodeScalar},  // the rest of VFP
    {0x0e000000, 0x0a000000, Kind::kBranch, decodeBranch},  // B, BL
    {0x0fffffd0, 0x012fff10, Kind::kBranch, decodeBranch},  // BX, BLX
    {0x0e000000, 0x04000000, Kind::kMemory, decodeMemory},  // LDR, STR
    {0x0e000010, 0x06000000, Kind::kMemory, decodeMemory},
    {0x0e000000, 0x08000000, Kind::kMemory, decodeMemory},  // LDM, STM, push, pop
    {0x0e0000f0, 0x000000b0, Kind::kMemory,
     decodeMemory},  // of half words, signed bytes, double words
    {0x0e0000d0, 0x000000d0, Kind::kMemory, decodeMemory},
    {0x0f8000f0, 0x01800090, Kind::kMemory, decodeMemory},  // exclusive
    {0x0c000000, 0x00000000, Kind::kInteger, decodeInteger},
    {0x0e000010, 0x06000010, Kind::kInteger, decodeInteger},  // USAD8, SXTB, UBFX ...
    {0x00000000, 0x00000000, Kind::kOther, nullptr},
};

}  // namespace

Instruction decode(std::uint32_t word) {
  Instruction result;
  const KindRule& rule = ruleFor(word, kKinds);
  result.kind = rule.kind;
  if (rule.decode != nullptr) rule.decode(word, result);
  const bool conditional = word >> 28U < 14;
  if (conditional && result.kind != Kind::kBranch) result.reads_e2 |= kFlagsBit;
  const bool into_pc = result.port == Instruction::kCore && (result.writes & kPc) != 0;
  if (into_pc && result.branch == Instruction::kNoBranch) result.branch = Instruction::kIndirect;
  return result;
}

}  // namespace ardrone_vslam::drone
