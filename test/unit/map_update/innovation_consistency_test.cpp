// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/innovation_consistency.hpp"

#include <gtest/gtest.h>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr int kCoordinates = 6;

Vector6d white(RandomSource& random) {
  Vector6d offset;
  for (int k = 0; k < kCoordinates; ++k) offset(k) = random.normal();
  return offset;
}

TEST(InnovationConsistency, FixesAsFarOffAsExpectedBlameNobody) {
  RandomSource random(1);
  InnovationConsistency consistency;
  double nis = 0;
  constexpr int kFixes = 2000;
  for (int i = 0; i < kFixes; ++i) {
    consistency.learn(white(random));
    EXPECT_EQ(consistency.odometryFactor(), 1);
    EXPECT_LT(consistency.mapFactor(), 2);
    nis += consistency.nis() / kFixes;
  }
  EXPECT_NEAR(nis, 1, 0.05);
}

TEST(InnovationConsistency, ManyTheSameWayBlameTheOdometry) {
  RandomSource random(2);
  InnovationConsistency consistency;
  Vector6d drift = Vector6d::Zero();
  drift(1) = 6;
  for (int i = 0; i < 50; ++i) consistency.learn(drift + white(random));
  EXPECT_GT(consistency.odometryFactor(), 5);
  EXPECT_LT(consistency.mapFactor(), 2);
}

TEST(InnovationConsistency, ToAndFroBlamesTheMap) {
  RandomSource random(3);
  InnovationConsistency consistency;
  for (int i = 0; i < 50; ++i) consistency.learn(2.5 * white(random));
  EXPECT_EQ(consistency.odometryFactor(), 1);
  EXPECT_GT(consistency.mapFactor(), 3);
}

TEST(InnovationConsistency, OneFixCountsNoMoreHoweverWrong) {
  InnovationConsistency consistency;
  consistency.learn(Vector6d::Constant(1e6));
  EXPECT_LT(consistency.nis(), 2);
  EXPECT_LT(consistency.odometryFactor(), 2);
}

}  // namespace
}  // namespace ardrone_vslam
