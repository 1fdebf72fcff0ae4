// SPDX-License-Identifier: BSD-3-Clause
#include "drone/cortex_a8.hpp"

#include <algorithm>

namespace ardrone_vslam::drone {
namespace {

// ARM DDI 0344K: 1.3.1 (branches), 16.5.1 and table 16-18 (memory), 16.6 (results of NEON into the
// core).
constexpr std::uint64_t kMispredicted = 13, kSecondLevel = 8, kTranslation = 24, kUnaligned = 8,
                        kIntoCore = 20;

std::uint64_t latest(std::uint32_t registers, const std::array<std::uint64_t, 32>& available) {
  std::uint64_t result = 0;
  for (; registers != 0; registers &= registers - 1) {
    result = std::max(result, available[static_cast<std::size_t>(__builtin_ctz(registers))]);
  }
  return result;
}

void set(std::uint32_t registers, std::uint64_t cycle, std::array<std::uint64_t, 32>& available) {
  for (; registers != 0; registers &= registers - 1)
    available[static_cast<std::size_t>(__builtin_ctz(registers))] = cycle;
}

// The cycle in which what is needed in a stage can be issued.
std::uint64_t forStage(std::uint64_t available, std::uint64_t stage) {
  return available > stage ? available - stage : 0;
}

}  // namespace

bool BranchPredictor::foretells(Instruction::Branch branch, std::uint32_t address,
                                std::uint32_t target) {
  const std::uint32_t next = address + 4;
  if (branch == Instruction::kCall) returns_[depth_++ % returns_.size()] = next;
  if (branch == Instruction::kConditional) {
    std::uint8_t& counter = counters_[((address >> 2U) ^ (history_ << 2U)) % counters_.size()];
    const bool taken = target != next;
    const bool right = (counter >= 2) == taken;
    if (taken && counter < 3) ++counter;
    if (!taken && counter > 0) --counter;
    history_ = ((history_ << 1U) | (taken ? 1U : 0U)) & 1023U;
    return right;
  }
  if (branch == Instruction::kReturn)
    return depth_ > 0 && returns_[--depth_ % returns_.size()] == target;
  if (branch != Instruction::kIndirect) return true;
  std::uint32_t& last = targets_[(address >> 2U) % targets_.size()];
  const bool right = last == target;
  last = target;
  return right;
}

void CortexA8::execute(const Instruction& instruction, std::uint32_t address) {
  if (last_.branch != Instruction::kNoBranch) endBranch(address);
  if (address >> 6U != last_address_ >> 6U && !levels_.code.lookUp(address, true)) {
    const std::uint64_t wait =
        kSecondLevel + (levels_.second.lookUp(address, true) ? 0 : memory_cycles_);
    cache_cycles_ += wait;
    waitUntil(cycle_ + wait);
  }
  issue(instruction);
  if (instruction.port != Instruction::kCore) issueBehind(instruction);
  last_ = instruction;
  last_address_ = address;
}

void CortexA8::endBranch(std::uint32_t next) {
  if (predictor_.foretells(last_.branch, last_address_, next)) return;
  branch_cycles_ += kMispredicted;
  waitUntil(cycle_ + kMispredicted);
}

void CortexA8::waitUntil(std::uint64_t cycle) {
  if (cycle <= cycle_) return;
  cycle_ = cycle;
  core_.slots = 0;
  core_.memory = false;
  core_.written = 0;
}

void CortexA8::issue(const Instruction& instruction) {
  waitUntil(std::max({forStage(latest(instruction.reads_e1, core_.available), 1),
                      forStage(latest(instruction.reads_e2, core_.available), 2),
                      forStage(latest(instruction.reads_e3, core_.available), 3)}));
  const std::uint32_t writes =
      (instruction.writes | instruction.writes_base) & ~(1U << Instruction::kFlags);
  const bool pairs = core_.slots < 2 && !(instruction.memory && core_.memory) &&
                     (!instruction.first_pipe || core_.slots == 0) &&
                     (writes & core_.written) == 0 && (instruction.cycles == 1 || core_.slots == 0);
  if (!pairs) waitUntil(cycle_ + 1);
  // A second one may join the last cycle of several.
  if (instruction.cycles > 1) waitUntil(cycle_ + instruction.cycles - 1U);
  set(instruction.writes, cycle_ + instruction.result_stage + 1U, core_.available);
  set(instruction.writes_base, cycle_ + 3, core_.available);
  ++core_.slots;
  core_.memory = core_.memory || instruction.memory;
  core_.written |= writes;
}

// Begins in NEON's or VFP's pipeline, when its turn, its registers and its port allow.
void CortexA8::issueBehind(const Instruction& instruction) {
  const std::uint64_t before = cycle_;
  waitUntil(behind_.begun[behind_.next]);
  const std::uint32_t registers = instruction.neon_reads;
  std::uint64_t& free = behind_.free[instruction.port];
  const std::uint64_t begin =
      std::max({cycle_, behind_.last, free, latest(registers, behind_.available)});
  behind_.last = begin;
  free = begin + instruction.neon_cycles;
  set(instruction.neon_writes, begin + instruction.neon_latency, behind_.available);
  // What was compared is in no register: VMRS waits for all.
  if (instruction.vfp && instruction.neon_writes == 0)
    set(instruction.neon_reads, begin + instruction.neon_latency, behind_.available);
  behind_.begun[behind_.next] = begin;
  behind_.next = (behind_.next + 1) % kQueue;
  if (instruction.to_core) {
    waitUntil(begin + kIntoCore);
    set(instruction.writes, cycle_, core_.available);
  }
  neon_waits_ += cycle_ - before;
}

unsigned CortexA8::missCycles(std::uint32_t address, bool store) {
  // A store that misses goes past the first level; it waits for nothing as long as the buffer of
  // stores lasts.
  const bool first = levels_.data.lookUp(address, !store);
  if (first) return 0;
  const bool second = levels_.second.lookUp(address, true);
  if (store) return 0;
  return static_cast<unsigned>(kSecondLevel) + (second ? 0U : memory_cycles_);
}

void CortexA8::access(std::uint32_t address, unsigned bytes, bool store) {
  std::uint64_t wait = levels_.pages.lookUp(address, true) ? 0 : kTranslation;
  wait += missCycles(address, store);
  if ((address + bytes - 1) >> 6U != address >> 6U) wait += missCycles(address + bytes - 1, store);
  const std::uint32_t within = store ? 7 : 15;
  if (last_.port == Instruction::kCore && (address & within) + bytes > within + 1)
    wait += kUnaligned;
  if (wait == 0) return;
  cache_cycles_ += wait;
  if (last_.port == Instruction::kCore) {
    waitUntil(cycle_ + wait);
    set(last_.writes, cycle_ + last_.result_stage + 1U, core_.available);
  } else {  // the core goes on until its queue is full
    std::uint64_t& free = behind_.free[Instruction::kNeonLoad];
    free += wait;
    behind_.last = std::max(behind_.last, free - 1);
    set(last_.neon_writes, free + 1, behind_.available);
  }
}

}  // namespace ardrone_vslam::drone
