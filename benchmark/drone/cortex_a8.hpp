// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "drone/cache.hpp"
#include "drone/instruction.hpp"

namespace ardrone_vslam::drone {

// Which branches are foretold: two-bit counters by address and the last ten directions, the last
// targets of 512 branches, and a stack of eight returns.
class BranchPredictor {
 public:
  // Whether the branch at `address` to `target` was foretold; learns from it.
  bool foretells(Instruction::Branch branch, std::uint32_t address, std::uint32_t target);

 private:
  std::array<std::uint8_t, 4096> counters_{};
  std::uint32_t history_ = 0;
  std::array<std::uint32_t, 512> targets_{};
  std::array<std::uint32_t, 8> returns_{};
  std::size_t depth_ = 0;
};

// Cycles of a Cortex-A8 as in the AR.Drone 2.0 (OMAP 3630: 32 KB of first-level data cache, 256 KB
// of second level), by a model of its pipelines; docs/onboard.md tells what is in it and what is
// not. Instructions are given one by one as they are executed, each followed by its memory
// accesses. The core issues two instructions a cycle, in order. NEON and VFP follow behind a queue
// of 16 instructions.
class CortexA8 {
 public:
  struct Cycles {
    std::uint64_t all = 0;
    std::uint64_t caches = 0;    // of them: waiting for the second level, memory and translation
    std::uint64_t branches = 0;  // not foretold
    std::uint64_t neon =
        0;  // the core waits for NEON or VFP: its queue is full, or a result comes back
  };

  // `memory_cycles`: of a line that is in no cache.
  explicit CortexA8(unsigned memory_cycles) : memory_cycles_(memory_cycles) {}

  void execute(const Instruction& instruction, std::uint32_t address);
  void access(std::uint32_t address, unsigned bytes, bool store);
  // So far.
  Cycles cycles() const { return {cycle_, cache_cycles_, branch_cycles_, neon_waits_}; }

 private:
  static constexpr std::size_t kQueue = 16;

  void endBranch(std::uint32_t next);
  void issue(const Instruction& instruction);
  void issueBehind(const Instruction& instruction);
  void waitUntil(std::uint64_t cycle);
  unsigned missCycles(std::uint32_t address, bool store);

  struct Core {
    std::array<std::uint64_t, 32> available{};  // by register: the cycle after its result's stage
    unsigned slots = 0;                         // taken in this cycle
    bool memory = false;
    std::uint32_t written = 0;
  } core_;
  struct Behind {
    std::array<std::uint64_t, 32> available{};  // by register of 64 bits
    std::array<std::uint64_t, 3> free{};        // by port
    std::uint64_t last = 0;                     // in order
    std::array<std::uint64_t, kQueue> begun{};  // of the last ones
    std::size_t next = 0;
  } behind_;
  struct Levels {
    Cache data{32768, 4, 6}, code{32768, 4, 6}, second{262144, 8, 6}, pages{32 * 4096, 32, 12};
  } levels_;
  BranchPredictor predictor_;
  Instruction last_;
  std::uint32_t last_address_ = 0;
  unsigned memory_cycles_;
  std::uint64_t cycle_ = 0, cache_cycles_ = 0, branch_cycles_ = 0, neon_waits_ = 0;
};

}  // namespace ardrone_vslam::drone
