// SPDX-License-Identifier: BSD-3-Clause
#include "heights/floor_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ardrone_vslam {
namespace {

using Answer = FloorWatch::Answer;

constexpr double kStep_m = 0.15;
constexpr double kSigma_m = 0.02;

/// The floor below is `floor_m(t)` high, the position 1 m above the first one. @return how often it
/// was told to be another one in `seconds`
template <class Floor>
int steps(FloorWatch& watch, double seconds, const Floor& floor_m) {
  int count = 0;
  double known_m = 0;
  for (double t_s = 0; t_s < seconds; t_s += 0.005) {
    const double innovation_m = known_m - floor_m(t_s);
    if (watch.see(t_s, innovation_m, kSigma_m, floor_m(t_s)) != Answer::kOther) continue;
    known_m = watch.floor_m();
    ++count;
  }
  return count;
}

TEST(FloorWatch, AStepThatStaysIsAnotherFloor) {
  FloorWatch watch(kStep_m);
  EXPECT_EQ(steps(watch, 5, [](double t_s) { return t_s < 1 ? 0 : 0.7; }), 1);
  EXPECT_NEAR(watch.floor_m(), 0.7, 1e-9);
  // As the drone smooths it.
  EXPECT_EQ(
      steps(watch, 5, [](double t_s) { return t_s < 1 ? 0 : 0.7 * -std::expm1(-(t_s - 1) / 0.1); }),
      1);
  EXPECT_NEAR(watch.floor_m(), 0.7, 0.03);
}

TEST(FloorWatch, WhatPassesAndWhatIsSmallIsNot) {
  FloorWatch watch(kStep_m);
  EXPECT_EQ(steps(watch, 5, [](double) { return 0.1; }), 0);
  EXPECT_EQ(steps(watch, 5, [](double t_s) { return t_s > 1 && t_s < 1.2 ? 0.7 : 0; }), 0);
  // A bad foresight may differ by more.
  EXPECT_EQ(watch.see(0, 0.4, 0.1, 0.4), Answer::kSame);
}

TEST(FloorWatch, UnsteadyHeightsAreTakenInTheEnd) {
  FloorWatch watch(kStep_m);
  const int count =
      steps(watch, 5, [](double t_s) { return t_s < 1 ? 0 : 0.7 + 0.2 * std::sin(30 * t_s); });
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace ardrone_vslam
