// SPDX-License-Identifier: BSD-3-Clause
// Plugin of qemu-arm: executed instructions by kind and by stage of the program, and with the
// argument memory=N the cycles that drone/cortex_a8.hpp's model takes for them, N for a line from
// memory. Equal to the last digit from run to run. The program tells a stage by close(-1000 -
// stage), which no kernel minds. Prints, at the end, a line for each stage.
#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <string>

#include "drone/cortex_a8.hpp"

using ardrone_vslam::drone::CortexA8;
using ardrone_vslam::drone::decode;
using ardrone_vslam::drone::Instruction;
using ardrone_vslam::drone::Kind;

// The functions that qemu offers (version 1 of its plugin interface), as Debian has no header of
// them.
extern "C" {
struct qemu_plugin_tb;
struct qemu_plugin_insn;
using plugin_id = std::uint64_t;
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, qemu_plugin_tb*));
void qemu_plugin_register_vcpu_syscall_cb(plugin_id,
                                          void (*)(plugin_id, unsigned, std::int64_t, std::uint64_t,
                                                   std::uint64_t, std::uint64_t, std::uint64_t,
                                                   std::uint64_t, std::uint64_t, std::uint64_t,
                                                   std::uint64_t));
void qemu_plugin_register_atexit_cb(plugin_id, void (*)(plugin_id, void*), void*);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
const void* qemu_plugin_insn_data(const qemu_plugin_insn*);
std::size_t qemu_plugin_insn_size(const qemu_plugin_insn*);
std::uint64_t qemu_plugin_insn_vaddr(const qemu_plugin_insn*);
void qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_insn*, int, void*, std::uint64_t);
void qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_insn*, void (*)(unsigned, void*), int,
                                            void*);
void qemu_plugin_register_vcpu_mem_cb(qemu_plugin_insn*,
                                      void (*)(unsigned, std::uint32_t, std::uint64_t, void*), int,
                                      int, void*);
unsigned qemu_plugin_mem_size_shift(std::uint32_t);
bool qemu_plugin_mem_is_store(std::uint32_t);
void qemu_plugin_outs(const char*);
__attribute__((visibility("default"))) int qemu_plugin_version = 1;
__attribute__((visibility("default"))) int qemu_plugin_install(plugin_id id, const void* info,
                                                               int argc, char** argv);
}

namespace {

constexpr int kAdd = 0, kNoRegisters = 0, kReadAndWrite = 3;  // of qemu's enumerations
constexpr std::int64_t kClose = 6;
constexpr int kFirstMark = 1000, kStages = 16;

constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::kKinds);
constexpr std::array<const char*, kKinds + 4> kNames = {
    "integer", "branch",        "memory",          "neon",       "neon_memory",
    "scalar",  "divide",        "scalar_memory",   "move",       "other",
    "cycles",  "cycles_caches", "cycles_branches", "cycles_neon"};

struct Executed {
  Instruction instruction;
  std::uint32_t address;
};

std::array<std::uint64_t, kKinds + 4> count,
    before;  // since the program's beginning; when this stage began
std::array<std::array<std::uint64_t, kKinds + 4>, kStages> of_stage;
std::size_t stage = kStages - 1;  // before the first mark
std::deque<Executed> instructions;
std::unique_ptr<CortexA8> model;

void executed(unsigned, void* instruction) {
  const auto& now = *static_cast<const Executed*>(instruction);
  model->execute(now.instruction, now.address);
}

void accessed(unsigned, std::uint32_t how, std::uint64_t address, void*) {
  model->access(static_cast<std::uint32_t>(address), 1U << qemu_plugin_mem_size_shift(how),
                qemu_plugin_mem_is_store(how));
}

void translated(plugin_id, qemu_plugin_tb* block) {
  for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
    qemu_plugin_insn* place = qemu_plugin_tb_get_insn(block, i);
    std::uint32_t word = 0xf57ff01f;  // in the place of Thumb's: nothing
    if (qemu_plugin_insn_size(place) == sizeof word)
      std::memcpy(&word, qemu_plugin_insn_data(place), sizeof word);
    const Instruction instruction = decode(word);
    qemu_plugin_register_vcpu_insn_exec_inline(
        place, kAdd, &count[static_cast<std::size_t>(instruction.kind)], 1);
    if (model == nullptr) continue;
    instructions.push_back(
        {instruction, static_cast<std::uint32_t>(qemu_plugin_insn_vaddr(place))});
    qemu_plugin_register_vcpu_insn_exec_cb(place, executed, kNoRegisters, &instructions.back());
    if (instruction.memory)
      qemu_plugin_register_vcpu_mem_cb(place, accessed, kNoRegisters, kReadAndWrite, nullptr);
  }
}

void closeStage() {
  if (model != nullptr) {
    const CortexA8::Cycles cycles = model->cycles();
    count[kKinds] = cycles.all;
    count[kKinds + 1] = cycles.caches;
    count[kKinds + 2] = cycles.branches;
    count[kKinds + 3] = cycles.neon;
  }
  for (std::size_t k = 0; k < count.size(); ++k) of_stage[stage][k] += count[k] - before[k];
  before = count;
}

void called(plugin_id, unsigned, std::int64_t number, std::uint64_t a1, std::uint64_t,
            std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t, std::uint64_t,
            std::uint64_t) {
  const int mark = -static_cast<std::int32_t>(a1) - kFirstMark;
  if (number != kClose || mark < 0 || mark >= kStages - 1) return;
  closeStage();
  stage = static_cast<std::size_t>(mark);
}

void finished(plugin_id, void*) {
  closeStage();
  for (std::size_t s = 0; s < kStages; ++s) {
    std::string line = "stage " + std::to_string(s);
    const std::size_t columns = model == nullptr ? kKinds : kNames.size();
    for (std::size_t k = 0; k < columns; ++k)
      line += std::string(" ") + kNames[k] + " " + std::to_string(of_stage[s][k]);
    qemu_plugin_outs((line + "\n").c_str());
  }
}

}  // namespace

int qemu_plugin_install(plugin_id id, const void*, int argc, char** argv) {
  for (int i = 0; i < argc; ++i) {
    if (std::strncmp(argv[i], "memory=", 7) == 0)
      model = std::make_unique<CortexA8>(std::atoi(argv[i] + 7));
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_vcpu_syscall_cb(id, called);
  qemu_plugin_register_atexit_cb(id, finished, nullptr);
  return 0;
}
