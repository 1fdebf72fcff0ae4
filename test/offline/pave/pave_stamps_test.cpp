// SPDX-License-Identifier: BSD-3-Clause
// The drone's clock: sound, begun anew, standing still, damaged.
#include "pave/pave_stamps.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// 30 frames a second from a time and a number on.
std::vector<PaveHeader> headers(int count, std::uint32_t first_ms, std::uint32_t first_number = 1) {
  std::vector<PaveHeader> all;
  for (int i = 0; i < count; ++i) {
    PaveHeader header;
    header.frame_number = first_number + static_cast<std::uint32_t>(i);
    header.timestamp_ms = first_ms + static_cast<std::uint32_t>(33 * i);
    all.push_back(header);
  }
  return all;
}

std::vector<PaveHeader> joined(std::vector<PaveHeader> a, const std::vector<PaveHeader>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expectAscending(const PaveStamps& stamps) {
  ASSERT_EQ(stamps.frames.size(), stamps.stamps_ns.size());
  for (std::size_t i = 1; i < stamps.frames.size(); ++i) {
    ASSERT_LT(stamps.frames[i - 1], stamps.frames[i]);
    ASSERT_LT(stamps.stamps_ns[i - 1], stamps.stamps_ns[i]) << i;
  }
}

TEST(PaveStamps, ASoundClockIsTakenAsItIs) {
  const PaveStamps stamps = stampsOf(headers(100, 5000));
  expectAscending(stamps);
  EXPECT_EQ(stamps.frames.size(), 100U);
  EXPECT_EQ(stamps.stamps_ns.back(), (5000 + 33 * 99) * kMillisecond_ns);
  EXPECT_EQ(stamps.restarts + stamps.spread_frames + stamps.dropped_frames, 0U);
  EXPECT_TRUE(stampsOf({}).frames.empty());
}

TEST(PaveStamps, GoOnWhereARestartedDronesClockBeginsAnew) {
  const auto restarted = joined(headers(60, 500'000, 900), headers(200, 3000));
  const PaveStamps stamps = stampsOf(restarted);
  expectAscending(stamps);
  EXPECT_EQ(stamps.frames.size(), 260U);  // neither part is lost
  EXPECT_EQ(stamps.restarts, 1U);
  EXPECT_EQ(stamps.dropped_frames, 0U);
  EXPECT_EQ(stamps.stamps_ns[60] - stamps.stamps_ns[59], 1000 * kMillisecond_ns);
  EXPECT_EQ(stamps.stamps_ns[61] - stamps.stamps_ns[60], 33 * kMillisecond_ns);
  EXPECT_EQ(stampsOf(joined(restarted, headers(40, 2000))).restarts, 2U);
}

TEST(PaveStamps, DamagedStampsAreNoRestart) {
  for (const std::uint32_t damaged_ms : {0U, 4'000'000'000U}) {
    for (const std::size_t at :
         {std::size_t{0}, std::size_t{1}, std::size_t{50}, std::size_t{99}}) {
      auto all = headers(100, 500'000);
      all[at].timestamp_ms = damaged_ms;
      const PaveStamps stamps = stampsOf(all);
      expectAscending(stamps);
      EXPECT_EQ(stamps.restarts, 0U) << at << " " << damaged_ms;
      EXPECT_EQ(stamps.frames.size() + stamps.dropped_frames, 100U);
      EXPECT_GE(stamps.frames.size(), 99U);
    }
  }
  // Around a restart they cost nothing else.
  auto all = joined(headers(60, 500'000), headers(60, 3000));
  all[58].timestamp_ms = 4'000'000'000U;
  all[63].timestamp_ms = 4'000'000'000U;
  const PaveStamps stamps = stampsOf(all);
  EXPECT_EQ(stamps.restarts, 1U);
  EXPECT_EQ(stamps.frames.size(), 118U);
}

TEST(PaveStamps, ReorderedGroupsAreNoRestart) {
  auto all = headers(90, 500'000);
  std::rotate(all.begin() + 30, all.begin() + 45, all.begin() + 60);
  EXPECT_EQ(stampsOf(all).restarts, 0U);
}

TEST(PaveStamps, AClockThatStandsStillIsSpreadByTheNumbers) {
  auto all = headers(100, 7000);
  for (PaveHeader& header : all) header.timestamp_ms = 7000;
  for (std::size_t i = 50; i < 100; ++i) all[i].frame_number += 3;  // lost ones
  const PaveStamps stamps = stampsOf(all);
  expectAscending(stamps);
  EXPECT_EQ(stamps.frames.size(), 100U);
  EXPECT_EQ(stamps.spread_frames, 100U);
  EXPECT_EQ(stamps.dropped_frames, 0U);
  EXPECT_EQ(stamps.stamps_ns.front(), 7000 * kMillisecond_ns);
  EXPECT_NEAR(static_cast<double>(stamps.stamps_ns.back() - stamps.stamps_ns.front()) * 1e-9,
              102 / 30.0, 1e-6);
}

TEST(PaveStamps, AClockThatTicksSlowlyTellsTheRate) {
  auto all = headers(100, 0);  // ticks once in ten frames at 20 frames a second
  for (std::size_t i = 0; i < 100; ++i)
    all[i].timestamp_ms = 1000 + 500 * static_cast<std::uint32_t>(i / 10);
  const PaveStamps stamps = stampsOf(all);
  expectAscending(stamps);
  EXPECT_EQ(stamps.frames.size(), 100U);
  EXPECT_NEAR(static_cast<double>(stamps.stamps_ns[99] - stamps.stamps_ns[0]) * 1e-9, 4.95, 0.5);
}

TEST(PaveStamps, AFewEqualStampsAreLeftOut) {
  auto all = headers(100, 7000);
  for (std::size_t i = 41; i < 50; ++i) all[i].timestamp_ms = all[40].timestamp_ms;
  const PaveStamps stamps = stampsOf(all);
  expectAscending(stamps);
  EXPECT_EQ(stamps.dropped_frames, 9U);
  EXPECT_EQ(stamps.spread_frames, 0U);
}

}  // namespace
}  // namespace ardrone_vslam
