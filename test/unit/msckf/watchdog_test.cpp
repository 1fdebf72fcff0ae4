// SPDX-License-Identifier: BSD-3-Clause
#include "msckf/watchdog.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kStep_ns = 100'000'000;

/// Shows the same, ten times a second. @return the seconds until trust ends, or nothing in 30 s
std::optional<double> secondsOfTrust(Watchdog& watchdog, const Contradiction& contradiction,
                                     std::int64_t from_ns = 0) {
  for (std::int64_t t = from_ns; t <= from_ns + 300 * kStep_ns; t += kStep_ns)
    if (watchdog.see(t, contradiction)) return static_cast<double>(t - from_ns) * 1e-9;
  return std::nullopt;
}

Contradiction biased(double deviations) {
  Contradiction contradiction;
  contradiction.bias_sigmas = deviations;
  return contradiction;
}

TEST(Watchdog, EndsTrustWhenTheBiasStaysBeyondItsLimit) {
  Watchdog watchdog;
  EXPECT_NEAR(secondsOfTrust(watchdog, biased(15.1)).value(), 3, 0.11);
  Watchdog other;
  EXPECT_FALSE(secondsOfTrust(other, biased(14.9)));
  EXPECT_FALSE(other.isCalm());
}

TEST(Watchdog, APlaceSeenBeforeConfirmsTheBias) {
  Watchdog watchdog;
  Contradiction contradiction = biased(50);
  contradiction.is_camera_confirmed = true;
  EXPECT_FALSE(secondsOfTrust(watchdog, contradiction));
}

TEST(Watchdog, EndsTrustWhenFixesStayFurtherOffThanTheyClaim) {
  Watchdog watchdog;
  Contradiction contradiction;
  contradiction.fix_nis = 8.1;
  contradiction.is_camera_confirmed = true;
  EXPECT_NEAR(secondsOfTrust(watchdog, contradiction).value(), 3, 0.11);
  Watchdog other;
  contradiction.fix_nis = 7.9;
  EXPECT_FALSE(secondsOfTrust(other, contradiction));
}

TEST(Watchdog, ImagesWithoutOldLandmarksSayNothingOfFixes) {
  Watchdog watchdog;
  Contradiction bad;
  bad.fix_nis = 9;
  int trusted_images = 0;
  for (std::int64_t i = 0; i < 200 && !watchdog.see(i * kStep_ns, i % 2 == 0 ? bad : biased(0));
       ++i)
    ++trusted_images;
  EXPECT_NEAR(trusted_images, 60, 3);  // 3 s of fixes in 6 s
}

/// Three images a second have tracks to compare.
Contradiction comparedAt(std::int64_t i, int agreed_tracks) {
  Contradiction contradiction;
  contradiction.tracks.travelled_m = 0.1 * static_cast<double>(i);
  if (i % 3 == 0) contradiction.tracks.tracks = 100;
  if (i % 3 == 0) contradiction.tracks.agreed = agreed_tracks;
  return contradiction;
}

TEST(Watchdog, EndsTrustWhenMostTracksContradict) {
  Watchdog watchdog;
  for (std::int64_t i = 0; i < 60; ++i) ASSERT_FALSE(watchdog.see(i * kStep_ns, comparedAt(i, 50)));
  for (std::int64_t i = 60; i < 90; ++i) {
    ASSERT_FALSE(watchdog.see(i * kStep_ns, comparedAt(i, 24))) << i;
    EXPECT_FALSE(watchdog.isCalm());
    // Two images may be chance; then all of the way since the first counts.
    EXPECT_NEAR(watchdog.doubtfulWay_m(), i < 66 ? 0 : 0.1 * static_cast<double>(i - 60), 1e-9);
  }
  EXPECT_TRUE(watchdog.see(90 * kStep_ns, comparedAt(90, 24)));
  EXPECT_EQ(watchdog.doubtfulWay_m(), 0) << "the pose is the odometry's";
  Watchdog other;
  for (std::int64_t i = 0; i < 300; ++i)
    ASSERT_FALSE(other.see(i * kStep_ns, comparedAt(i, 25))) << "wrong matches, " << i;
  EXPECT_GT(other.doubtfulWay_m(), 29);
}

TEST(Watchdog, ARestBetweenTwoImagesIsNoContradiction) {
  Watchdog watchdog;
  EXPECT_FALSE(watchdog.see(0, comparedAt(3, 0)));
  EXPECT_FALSE(watchdog.see(600 * kStep_ns, comparedAt(6, 0)));
  EXPECT_FALSE(watchdog.see(1200 * kStep_ns, comparedAt(9, 0)));
}

TEST(Watchdog, WhereNothingIsComparedTheDoubtGrowsNoMore) {
  Watchdog watchdog;
  for (std::int64_t i = 0; i < 12; ++i) watchdog.see(i * kStep_ns, comparedAt(i, 0));
  for (std::int64_t i = 1; i < 100; ++i)
    watchdog.see((12 + i) * kStep_ns, comparedAt(3 * i + 13, 0));
  EXPECT_LT(watchdog.doubtfulWay_m(), 0.3 * 50 + 1.5) << "5 s, of 10";
}

TEST(Watchdog, OneImageWhoseTracksAgreeEndsTheDoubt) {
  Watchdog watchdog;
  for (std::int64_t i = 0; i < 300; ++i)
    ASSERT_FALSE(watchdog.see(i * kStep_ns, comparedAt(i, i % 27 == 0 ? 80 : 0))) << i;
  Contradiction few = comparedAt(0, 0);
  few.tracks.tracks = 7;
  Watchdog other;
  EXPECT_FALSE(secondsOfTrust(other, few)) << "too few tracks say nothing";
}

TEST(Watchdog, IsCalmWellBelowTheLimits) {
  Watchdog watchdog;
  watchdog.see(0, biased(4));
  EXPECT_TRUE(watchdog.isCalm());
  watchdog.see(kStep_ns, biased(6));
  EXPECT_FALSE(watchdog.isCalm());
}

TEST(Watchdog, PausesTwiceAsLongEachTime) {
  Watchdog watchdog;
  std::int64_t now_ns = 0;
  for (const double pause_s : {10.0, 20.0, 40.0}) {
    EXPECT_FALSE(watchdog.isDistrustful(now_ns));
    now_ns += static_cast<std::int64_t>(secondsOfTrust(watchdog, biased(20), now_ns).value() * 1e9);
    const auto pause_ns = static_cast<std::int64_t>(pause_s * 1e9);
    EXPECT_TRUE(watchdog.isDistrustful(now_ns + pause_ns - 1));
    EXPECT_FALSE(watchdog.isDistrustful(now_ns + pause_ns));
    now_ns += pause_ns;
  }
}

}  // namespace
}  // namespace ardrone_vslam
