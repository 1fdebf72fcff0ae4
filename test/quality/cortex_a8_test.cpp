// SPDX-License-Identifier: BSD-3-Clause
// The model of the drone's processor beside its manual (ARM DDI 0344K). Words are from an
// assembler.
#include "drone/cortex_a8.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "drone/instruction.hpp"

namespace ardrone_vslam::drone {
namespace {

using Cycles = std::vector<std::uint64_t>;
using Words = std::vector<std::uint32_t>;
constexpr unsigned kMemory = 100;  // cycles

// In which cycle each is issued (of several cycles: its last one), from that of a first one that
// stands alone. All lie at one address: its line is in the cache.
Cycles cyclesOf(const Words& words) {
  constexpr std::uint32_t kAddress = 0x8000;
  CortexA8 processor(kMemory);
  processor.execute(decode(0xe1a00000), kAddress);  // mov r0, r0
  processor.execute(decode(0xe1a01001), kAddress);  // mov r1, r1
  const std::uint64_t first = processor.cycles().all + 1;
  Cycles result;
  for (const std::uint32_t word : words) {
    processor.execute(decode(word), kAddress);
    result.push_back(processor.cycles().all - first);
  }
  return result;
}

// Of one among many equal instructions for NEON or VFP.
double cyclesEach(std::uint32_t word) {
  const auto until_done = [word](std::size_t count) {
    Words words(count, word);
    words.push_back(0xeef1fa10);  // vmrs apsr_nzcv, fpscr
    return static_cast<double>(cyclesOf(words).back());
  };
  return (until_done(200) - until_done(100)) / 100;
}

struct Line {
  std::uint32_t address, word;
  std::uint64_t cycle;
};

// The manual's example 16-6. Before it stand the calls that its returns belong to; the second time
// all is foretold.
TEST(CortexA8, SchedulesTheExampleOfItsManual) {
  const std::vector<Line> example = {
      {0xed0, 0xe12fff1e, 1},    // bx r14
      {0xee4, 0xe3500000, 1},    // cmp r0, #0
      {0xee8, 0xe3a03003, 2},    // mov r3, #3
      {0xeec, 0xe3a00000, 2},    // mov r0, #0
      {0xef0, 0x05813000, 3},    // streq r3, [r1]
      {0xef4, 0xe3520004, 3},    // cmp r2, #4
      {0xef8, 0x979ff102, 5},    // ldrls pc, [pc, r2, lsl #2], in cycles 4 and 5
      {0xf2c, 0xe3a00001, 5},    // mov r0, #1
      {0xf30, 0xea000000, 6},    // b
      {0xf38, 0xe5810000, 6},    // str r0, [r1]
      {0xf3c, 0xe49df004, 8},    // ldr pc, [r13], #4, in cycles 7 and 8
      {0x17c, 0xe284200c, 8},    // add r2, r4, #12
      {0x180, 0xe5960004, 9},    // ldr r0, [r6, #4]
      {0x184, 0xe3a0100a, 9},    // mov r1, #10
      {0x188, 0xe5900000, 12},   // ldr r0, [r0]
      {0x18c, 0xe5840000, 13}};  // str r0, [r4]
  CortexA8 processor(kMemory);
  Cycles cycles;
  for (int round = 0; round < 2; ++round) {
    cycles.clear();
    processor.execute(decode(0xeb000358), 0x178);  // bl
    processor.execute(decode(0xebfffffa), 0xee0);  // bl
    for (const std::uint32_t word : {0xe1a09009, 0xe1a09009, 0xe1a08008})
      processor.execute(decode(word), 0xec0);  // mov
    for (const Line& line : example) {
      processor.execute(decode(line.word), line.address);
      cycles.push_back(processor.cycles().all);
    }
  }
  for (std::size_t i = 0; i < example.size(); ++i) {
    EXPECT_EQ(cycles[i] - cycles[0] + 1, example[i].cycle) << std::hex << example[i].address;
  }
}

TEST(CortexA8, WaitsForResultsOfTheCore) {
  EXPECT_EQ(cyclesOf({0xe0810002, 0xe0803004}), (Cycles{0, 1})) << "add r0, r1, r2; add r3, r0, r4";
  EXPECT_EQ(cyclesOf({0xe5910000, 0xe0801000}), (Cycles{0, 2})) << "ldr r0, [r1]; add r1, r0, r0";
  EXPECT_EQ(cyclesOf({0xe5910000, 0xe5901000}), (Cycles{0, 3})) << "ldr r0, [r1]; ldr r1, [r0]";
  EXPECT_EQ(cyclesOf({0xe0000291, 0xe0803004}), (Cycles{1, 5})) << "mul r0, r1, r2; add r3, r0, r4";
  EXPECT_EQ(cyclesOf({0xe8b0001e, 0xe3a05001, 0xe3a06001}), (Cycles{1, 1, 2}))
      << "ldm r0!, {r1-r4}; mov r5, #1; mov r6, #1";
}

TEST(CortexA8, OverlapsNothingInScalarVfp) {
  EXPECT_NEAR(cyclesEach(0xee303b00), 10, 0.5) << "vadd.f64 d3, d0, d0";
  EXPECT_NEAR(cyclesEach(0xee210b02), 14, 0.5) << "vmul.f64 d0, d1, d2";
  EXPECT_NEAR(cyclesEach(0xee010b02), 22, 0.5) << "vmla.f64 d0, d1, d2";
  EXPECT_NEAR(cyclesEach(0xee810b02), 47, 0.5) << "vdiv.f64 d0, d1, d2";
  EXPECT_NEAR(cyclesEach(0xee310aaf), 10, 0.5) << "vadd.f32 s0, s3, s31";
}

TEST(CortexA8, OverlapsVectorsThatDoNotWaitForEachOther) {
  EXPECT_NEAR(cyclesEach(0xf2020d54), 9, 0.5) << "vmla.f32 q0, q1, q2 into the same sum";
  EXPECT_NEAR(cyclesEach(0xf3820c03), 1, 0.5) << "vmull.u8 q0, d2, d3";
  EXPECT_NEAR(cyclesEach(0xf2a30552), 1, 0.5) << "vshl.i32 q0, q1, #3";
}

TEST(CortexA8, WaitsTwentyCyclesForWhatComesBackIntoTheCore) {
  EXPECT_EQ(cyclesOf({0xec510b10}), (Cycles{20})) << "vmov r0, r1, d0";
  EXPECT_EQ(cyclesOf({0xee303b00, 0xec510b13}), (Cycles{0, 30}))
      << "vadd.f64 d3, d0, d0; vmov r0, r1, d3";
  EXPECT_EQ(cyclesOf({0xeeb40b41, 0xeef1fa10}), (Cycles{0, 26}))
      << "vcmp.f64 d0, d1; vmrs apsr_nzcv, fpscr";
}

TEST(CortexA8, StopsWhenTheQueueIsFull) {
  const Cycles cycles = cyclesOf(Words(40, 0xee303b00));  // vadd.f64 d3, d0, d0
  EXPECT_LT(cycles[15], 16U);
  EXPECT_NEAR(static_cast<double>(cycles[39]), 10.0 * (39 - 16), 1.0);
}

TEST(CortexA8, CountsWhatIsInNoCache) {
  CortexA8 processor(kMemory);
  const Instruction load = decode(0xe5910000);  // ldr r0, [r1]
  const auto waits = [&](std::uint32_t address, unsigned bytes) {
    const std::uint64_t before = processor.cycles().caches;
    processor.execute(load, 0x8000);
    processor.access(address, bytes, false);
    return processor.cycles().caches - before;
  };
  processor.execute(load, 0x8000);  // its code
  EXPECT_EQ(waits(0x20000, 4), 24 + 8 + kMemory) << "page and line are new";
  EXPECT_EQ(waits(0x20004, 4), 0U);
  EXPECT_EQ(waits(0x20040, 4), 8 + kMemory);
  EXPECT_EQ(waits(0x2000e, 4), 8U) << "across 16 bytes";
  for (std::uint32_t line = 1; line <= 4; ++line)
    waits(0x20000 + (line << 13U), 4);  // of the same set
  EXPECT_EQ(waits(0x20000, 4), 8U) << "of the second level";
}

TEST(CortexA8, LearnsBranches) {
  CortexA8 processor(kMemory);
  const Instruction branch = decode(0x1afffffe);  // bne
  const auto fails = [&](int passes) {
    const std::uint64_t before = processor.cycles().branches;
    for (int i = 0; i < passes; ++i) processor.execute(branch, 0x8000);  // always taken
    return (processor.cycles().branches - before) / 13;
  };
  EXPECT_GT(fails(30), 0U);
  EXPECT_EQ(fails(1000), 0U);
}

// What an instruction reads and writes decides what waits for it.
TEST(DroneInstruction, KnowsItsRegisters) {
  const auto core = [](std::initializer_list<int> numbers) {
    std::uint32_t result = 0;
    for (const int number : numbers) result |= 1U << static_cast<unsigned>(number);
    return result;
  };
  struct Case {
    const char* text;
    std::uint32_t word, reads, writes, neon_reads, neon_writes;
  };
  const Case cases[] = {
      {"vmla.f32 q0, q1, q2", 0xf2020d54, 0, 0, core({0, 1, 2, 3, 4, 5}), core({0, 1})},
      {"vmla.f32 q0, q1, d4[0]", 0xf3a20144, 0, 0, core({0, 1, 2, 3, 4}), core({0, 1})},
      {"vmull.u8 q8, d2, d6", 0xf3c20c06, 0, 0, core({2, 6}), core({16, 17})},
      {"vaddw.u8 q1, q2, d31", 0xf384212f, 0, 0, core({4, 5, 31}), core({2, 3})},
      {"vaddhn.i16 d0, q1, q2", 0xf2820404, 0, 0, core({2, 3, 4, 5}), core({0})},
      {"vmlal.s16 q0, d3, d2[1]", 0xf293024a, 0, 0, core({0, 1, 2, 3}), core({0, 1})},
      {"vshr.u32 q1, q2, #3", 0xf3bd2054, 0, 0, core({4, 5}), core({2, 3})},
      {"vsra.u32 d1, d2, #3", 0xf3bd1112, 0, 0, core({1, 2}), core({1})},
      {"vzip.8 q0, q1", 0xf3b201c2, 0, 0, core({0, 1, 2, 3}), core({0, 1, 2, 3})},
      {"vmovl.u8 q2, d3", 0xf3884a13, 0, 0, core({3}), core({4, 5})},
      {"vmovn.i16 d2, q5", 0xf3b2220a, 0, 0, core({10, 11}), core({2})},
      {"vld1.32 {d0, d1}, [r0]!", 0xf4200a8d, core({0}), core({0}), 0, core({0, 1})},
      {"vldmia r0!, {d0-d3}", 0xecb00b08, core({0}), core({0}), 0, core({0, 1, 2, 3})},
      {"vcvt.f64.f32 d5, s3", 0xeeb75ae1, 0, 0, core({1}), core({5})},
      {"vadd.f32 s0, s3, s31", 0xee310aaf, 0, 0, core({1, 15}), core({0})},
      {"vmov.32 r0, d5[1]", 0xee350b10, 0, core({0}), core({5}), 0},
      {"vdup.32 q3, r2", 0xeea62b10, core({2}), 0, 0, core({6, 7})},
      {"ldm r0!, {r1-r4}", 0xe8b0001e, core({0}), core({0, 1, 2, 3, 4}), 0, 0},
      {"str r0, [r1]", 0xe5810000, core({0, 1}), 0, 0, 0},
      {"mul r0, r1, r2", 0xe0000291, core({1, 2}), core({0}), 0, 0},
  };
  for (const Case& one : cases) {
    const Instruction instruction = decode(one.word);
    EXPECT_EQ(instruction.reads_e1 | instruction.reads_e2 | instruction.reads_e3, one.reads)
        << one.text;
    EXPECT_EQ(instruction.writes | instruction.writes_base, one.writes) << one.text;
    EXPECT_EQ(instruction.neon_reads, one.neon_reads) << one.text;
    EXPECT_EQ(instruction.neon_writes, one.neon_writes) << one.text;
  }
}

}  // namespace
}  // namespace ardrone_vslam::drone
