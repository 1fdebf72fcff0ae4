/* SPDX-License-Identifier: BSD-3-Clause */
/* Plugin of qemu-arm: executed instructions by kind and by stage of the program, equal to the last
 * digit from run to run. The program tells a stage by close(-1000 - stage), which no kernel minds.
 * Prints, at the end, a line for each stage. The functions that qemu offers are declared here
 * (version 1 of its plugin interface), as Debian has no header of them. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef uint64_t plugin_id;
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_syscall_cb(plugin_id,
                                          void (*)(plugin_id, unsigned, int64_t, uint64_t, uint64_t,
                                                   uint64_t, uint64_t, uint64_t, uint64_t, uint64_t,
                                                   uint64_t));
void qemu_plugin_register_atexit_cb(plugin_id, void (*)(plugin_id, void*), void*);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t);
const void* qemu_plugin_insn_data(const struct qemu_plugin_insn*);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn*);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn*, int, void*, uint64_t);
void qemu_plugin_outs(const char*);

#define VISIBLE __attribute__((visibility("default")))
VISIBLE int qemu_plugin_version = 1;

enum kind {
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
static const char* const names[kKinds] = {"integer",     "branch", "memory", "neon",
                                          "neon_memory", "scalar", "divide", "scalar_memory",
                                          "move",        "other"};

/* ARM's A32 encoding; the first rule that fits counts. */
static const struct {
  uint32_t mask, value;
  enum kind kind;
} rules[] = {
    {0xfe000000, 0xf2000000, kNeon},         /* vectors */
    {0xff100000, 0xf4000000, kNeonMemory},   /* VLD1..4, VST1..4 */
    {0xfe000000, 0xfa000000, kBranch},       /* BLX to Thumb */
    {0xf0000000, 0xf0000000, kOther},        /* PLD, barriers */
    {0x0fe00e00, 0x0c400a00, kMove},         /* VMOV of two registers to or from the core */
    {0x0e000e00, 0x0c000a00, kScalarMemory}, /* VLDR, VSTR, VLDM, VSTM: of vectors as well */
    {0x0f000e10, 0x0e000a10, kMove},         /* VMOV and VDUP to or from the core, VMRS */
    {0x0fb00e50, 0x0e800a00, kDivide},       /* VDIV */
    {0x0fbf0ed0, 0x0eb10ac0, kDivide},       /* VSQRT */
    {0x0f000e10, 0x0e000a00, kScalar},       /* the rest of VFP: not pipelined on the Cortex-A8 */
    {0x0e000000, 0x0a000000, kBranch},       /* B, BL */
    {0x0fffffd0, 0x012fff10, kBranch},       /* BX, BLX */
    {0x0e000000, 0x04000000, kMemory},       /* LDR, STR */
    {0x0e000010, 0x06000000, kMemory},
    {0x0e000000, 0x08000000, kMemory}, /* LDM, STM, push, pop */
    {0x0e0000f0, 0x000000b0, kMemory}, /* of half words, signed bytes, double words */
    {0x0e0000d0, 0x000000d0, kMemory},
    {0x0f8000f0, 0x01800090, kMemory}, /* exclusive */
    {0x0c000000, 0x00000000, kInteger},
    {0x0e000010, 0x06000010, kInteger}, /* USAD8, SXTB, UBFX ... */
    {0x00000000, 0x00000000, kOther},
};

enum { kFirstMark = 1000, kStages = 16 };
static uint64_t count[kKinds];  /* since the program's beginning */
static uint64_t before[kKinds]; /* when this stage began */
static uint64_t of_stage[kStages][kKinds];
static unsigned stage = kStages - 1; /* before the first mark */

static enum kind kind_of(struct qemu_plugin_insn* instruction) {
  uint32_t word;
  size_t i = 0;
  if (qemu_plugin_insn_size(instruction) != sizeof word) return kOther; /* Thumb */
  memcpy(&word, qemu_plugin_insn_data(instruction), sizeof word);
  while ((word & rules[i].mask) != rules[i].value) ++i;
  return rules[i].kind;
}

static void translated(plugin_id id, struct qemu_plugin_tb* block) {
  (void)id;
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
    struct qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, i);
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, 0 /* add */,
                                               &count[kind_of(instruction)], 1);
  }
}

static void close_stage(void) {
  for (int k = 0; k < kKinds; ++k) {
    of_stage[stage][k] += count[k] - before[k];
    before[k] = count[k];
  }
}

static void called(plugin_id id, unsigned cpu, int64_t number, uint64_t a1, uint64_t a2,
                   uint64_t a3, uint64_t a4, uint64_t a5, uint64_t a6, uint64_t a7, uint64_t a8) {
  const int32_t mark = -(int32_t)a1 - kFirstMark;
  (void)id, (void)cpu, (void)a2, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (number != 6 /* close */ || mark < 0 || mark >= kStages - 1) return;
  close_stage();
  stage = (unsigned)mark;
}

static void finished(plugin_id id, void* unused) {
  (void)id, (void)unused;
  close_stage();
  for (int s = 0; s < kStages; ++s) {
    char line[512];
    int length = snprintf(line, sizeof line, "stage %d", s);
    for (int k = 0; k < kKinds; ++k) {
      length += snprintf(line + length, sizeof line - (size_t)length, " %s %llu", names[k],
                         (unsigned long long)of_stage[s][k]);
    }
    snprintf(line + length, sizeof line - (size_t)length, "\n");
    qemu_plugin_outs(line);
  }
}

VISIBLE int qemu_plugin_install(plugin_id id, const void* info, int argc, char** argv) {
  (void)info, (void)argc, (void)argv;
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_vcpu_syscall_cb(id, called);
  qemu_plugin_register_atexit_cb(id, finished, NULL);
  return 0;
}
