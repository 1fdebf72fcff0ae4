// SPDX-License-Identifier: BSD-3-Clause
#include "protocol/clock_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ardrone_vslam::test {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kDronePeriod_ns = kSecond_ns / 30;
constexpr std::int64_t kNow_ns = 1'700'000'000 * kSecond_ns;  // ours
constexpr std::int64_t kBooted_ns = 77 * kSecond_ns;          // the drone's at the same time

TEST(ClockMap, TheFastestArrivalTellsTheDifference) {
  ClockMap clock;
  const std::int64_t delays_ms[] = {40, 12, 90, 7, 30, 8, 7, 200};
  std::int64_t least_ms = 1000;
  for (int i = 0; i < 8; ++i) {
    const std::int64_t after_ns = i * kDronePeriod_ns;
    least_ms = std::min(least_ms, delays_ms[i]);
    const std::int64_t mapped_ns =
        clock.map(kBooted_ns + after_ns, kNow_ns + after_ns + delays_ms[i] * kMillisecond_ns);
    EXPECT_EQ(mapped_ns, kNow_ns + after_ns + least_ms * kMillisecond_ns) << i;
  }
}

TEST(ClockMap, StampsAscendAndNoneIsOfTheFuture) {
  std::mt19937 random(1);
  std::exponential_distribution<double> delay_s(10);  // 0.1 s in the mean: three images
  ClockMap clock;
  std::int64_t before_ns = 0;
  std::int64_t arrival_ns = kNow_ns;
  int clamped = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::int64_t stamp_ns = kBooted_ns + i * kDronePeriod_ns;
    arrival_ns = std::max<std::int64_t>(
        arrival_ns + 1000, kNow_ns + i * kDronePeriod_ns + std::llround(delay_s(random) * 1e9));
    const std::int64_t mapped_ns = clock.map(stamp_ns, arrival_ns);
    EXPECT_GT(mapped_ns, before_ns) << i;
    EXPECT_LE(mapped_ns, arrival_ns) << i;
    clamped += mapped_ns == before_ns + 1 ? 1 : 0;
    before_ns = mapped_ns;
  }
  EXPECT_LT(clamped, 50) << "only while the fastest is yet to come";
}

TEST(ClockMap, FollowsAClockThatDrifts) {
  for (const double drift : {-100e-6, 100e-6}) {
    ClockMap clock;
    double worst_s = 0;
    for (int i = 0; i < 30 * 600; ++i) {
      const std::int64_t after_ns = i * kDronePeriod_ns;
      const auto stamp_ns = kBooted_ns + std::llround(static_cast<double>(after_ns) * (1 + drift));
      const std::int64_t true_ns = kNow_ns + after_ns;
      const std::int64_t mapped_ns = clock.map(stamp_ns, true_ns + 5 * kMillisecond_ns);
      worst_s =
          std::max(worst_s, std::abs(static_cast<double>(mapped_ns - true_ns)) * 1e-9 - 0.005);
    }
    EXPECT_LT(worst_s, 100e-6 * 2 * 30 + 1e-6) << drift;  // in two windows
  }
}

TEST(ClockMap, BeginsAnewAfterALongSilenceAndWhenToldTo) {
  ClockMap clock;
  clock.map(kBooted_ns, kNow_ns);
  // The workstation's clock was set by an hour in the silence.
  const std::int64_t silence_ns = 2 * ClockMap::kWindow_ns + 3600 * kSecond_ns;
  EXPECT_EQ(clock.map(kBooted_ns + 61 * kSecond_ns, kNow_ns + silence_ns), kNow_ns + silence_ns);
  clock.clear();
  EXPECT_EQ(clock.offset_ns(), 0);
  EXPECT_EQ(clock.map(1, kNow_ns + silence_ns + kSecond_ns), kNow_ns + silence_ns + kSecond_ns);
}

TEST(ClockMap, FollowsItsOwnClockThatIsSetBack) {
  ClockMap clock;
  clock.map(kBooted_ns, kNow_ns);
  const std::int64_t back_ns = kNow_ns - 3600 * kSecond_ns;
  EXPECT_EQ(clock.map(kBooted_ns + kDronePeriod_ns, back_ns), back_ns);
}

}  // namespace
}  // namespace ardrone_vslam::test
