// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace ardrone_vslam::drone {

enum class Kind : std::uint8_t {
  kInteger,
  kBranch,
  kMemory,
  kNeon,
  kNeonMemory,
  kScalar,
  kDivide,
  kScalarMemory,
  kMove,
  kOther,
  kKinds
};

// What the pipeline model needs to know of an A32 instruction. Cycles and stages are those of the
// Cortex-A8 Technical Reference Manual (ARM DDI 0344K), chapter 16: the core's results and sources
// by stage E1 to E5, those of NEON and VFP by cycles. Where the manual gives a range (scalar VFP),
// its middle is taken.
struct Instruction {
  enum Port : std::uint8_t { kCore, kNeonData, kNeonLoad };
  enum Branch : std::uint8_t { kNoBranch, kConditional, kDirect, kCall, kReturn, kIndirect };
  static constexpr unsigned kFlags = 16;  // as a register

  Kind kind = Kind::kOther;
  Port port = kCore;
  Branch branch = kNoBranch;
  bool memory = false;
  bool first_pipe = false;  // multiplications
  bool to_core = false;     // a register of NEON or VFP, or the flags, into the core
  bool vfp = false;         // not pipelined
  std::uint8_t cycles = 1;  // in the core
  std::uint8_t result_stage = 2;
  std::uint8_t neon_cycles = 0;
  std::uint8_t neon_latency = 0;
  std::uint32_t reads_e1 = 0, reads_e2 = 0,
                reads_e3 = 0;                     // a bit for each of r0 to r15 and the flags
  std::uint32_t writes = 0;                       // at result_stage
  std::uint32_t writes_base = 0;                  // addresses written back, at E2
  std::uint32_t neon_reads = 0, neon_writes = 0;  // a bit for each of d0 to d31
};

Instruction decode(std::uint32_t word);

}  // namespace ardrone_vslam::drone
