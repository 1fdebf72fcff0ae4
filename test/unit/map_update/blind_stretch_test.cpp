// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/blind_stretch.hpp"

#include <gtest/gtest.h>

namespace ardrone_vslam {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

Clone anchorOf(double stamp_s) {
  Clone anchor;
  anchor.stamp_ns = static_cast<std::int64_t>(stamp_s * 1e9);
  return anchor;
}

TEST(BlindStretch, WithoutOneNothingIsFromBefore) {
  BlindStretch blind;
  EXPECT_FALSE(blind.isAfter(anchorOf(1)));
  Clone loaded = anchorOf(1);
  loaded.is_loaded = true;
  EXPECT_FALSE(blind.isAfter(loaded));
  blind.note(10 * kSecond_ns);
  blind.note(12 * kSecond_ns);
  EXPECT_TRUE(blind.isAfter(anchorOf(9)));
  EXPECT_FALSE(blind.isAfter(anchorOf(11))) << "it is the first image that counts";
  loaded = anchorOf(100);
  loaded.is_loaded = true;
  EXPECT_TRUE(blind.isAfter(loaded));
  blind.note(40 * kSecond_ns);
  EXPECT_TRUE(blind.isAfter(anchorOf(39))) << "another one, long after";
  blind.forget();
  EXPECT_FALSE(blind.isAfter(anchorOf(9)));
}

TEST(BlindStretch, WhatTheCovarianceExplainsCorrects) {
  BlindStretch blind;
  blind.note(10 * kSecond_ns);
  EXPECT_TRUE(blind.judge(11 * kSecond_ns, true));
  EXPECT_FALSE(blind.judge(12 * kSecond_ns, false));
  EXPECT_TRUE(blind.judge(13 * kSecond_ns, true));
  EXPECT_TRUE(blind.judge(15 * kSecond_ns, true)) << "not for three seconds yet";
  EXPECT_FALSE(blind.judge(15 * kSecond_ns + 1, false));
  for (const int s : {16, 17, 19, 20}) EXPECT_TRUE(blind.judge(s * kSecond_ns, true));
  EXPECT_FALSE(blind.judge(20 * kSecond_ns + 1, false)) << "17 to 19 was too long a gap";
  for (const int s : {21, 22, 23, 24, 25}) EXPECT_TRUE(blind.judge(s * kSecond_ns, true));
  EXPECT_TRUE(blind.judge(26 * kSecond_ns, false)) << "the camera was where it was thought to be";
}

TEST(BlindStretch, AfterAWhileTheOdometryIsBlamed) {
  BlindStretch blind;
  blind.note(10 * kSecond_ns);
  blind.note(15 * kSecond_ns);
  EXPECT_FALSE(blind.judge(34 * kSecond_ns, false));
  EXPECT_TRUE(blind.judge(36 * kSecond_ns, false));
}

}  // namespace
}  // namespace ardrone_vslam
