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
