// SPDX-License-Identifier: BSD-3-Clause
// What BiasLevel learns of a bias that a Kalman filter follows, against the bias that was drawn.
#include "noise/bias_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kRate_hz = 10;
constexpr double kFade_s = 20;  // of the bias
constexpr double kConfigured_m_s = 0.03;
constexpr int kSeeds = 40;

/// Each axis by itself: the bias is measured ten times a second, and its level is learned.
/// @return the level over the root mean square of the bias that was drawn
double learnedOverDrawn(double sigma_m_s, double measurement_sigma_m_s, std::uint64_t seed) {
  const double keep = std::exp(-1 / (kRate_hz * kFade_s));
  const double measured_variance = measurement_sigma_m_s * measurement_sigma_m_s;
  RandomSource random(seed, 5);
  BiasLevel level(kConfigured_m_s);
  Eigen::Vector3d bias = sigma_m_s * random.normal3();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double variance = kConfigured_m_s * kConfigured_m_s;
  double squares = 0;
  constexpr int kSteps = static_cast<int>(60 * kRate_hz);
  for (int i = 0; i < kSteps; ++i) {
    level.learn(mean, variance * Eigen::Matrix3d::Identity(), 1, 1 / kRate_hz);
    bias = keep * bias + sigma_m_s * std::sqrt(1 - keep * keep) * random.normal3();
    squares += bias.squaredNorm() / (3 * kSteps);
    mean *= keep;
    variance = keep * keep * variance + (1 - keep * keep) * level.variance();
    const double gain = variance / (variance + measured_variance);
    mean += gain * (bias + measurement_sigma_m_s * random.normal3() - mean);
    variance *= 1 - gain;
  }
  return std::sqrt(level.variance() / squares);
}

// Measured: deciles 0.91 to 1.41 of the bias drawn.
TEST(BiasLevel, IsThatOfTheBiasWithinAMinute) {
  for (const double sigma_m_s : {0.02, 0.03, 0.13, 0.4}) {
    std::vector<double> ratios;
    for (int seed = 1; seed <= kSeeds; ++seed)
      ratios.push_back(learnedOverDrawn(sigma_m_s, 0.05, seed));
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[kSeeds / 10], 1 / 1.5) << sigma_m_s;
    EXPECT_LT(ratios[kSeeds * 9 / 10], 1.5) << sigma_m_s;
  }
}

TEST(BiasLevel, StaysAsConfiguredWhereNothingIsMeasured) {
  BiasLevel level(kConfigured_m_s);
  const double variance = kConfigured_m_s * kConfigured_m_s;
  for (int i = 0; i < 1000; ++i)
    level.learn(Eigen::Vector3d::Zero(), variance * Eigen::Matrix3d::Identity(), 1, 0.1);
  EXPECT_NEAR(std::sqrt(level.variance()), kConfigured_m_s, 1e-12);
}

TEST(BiasLevel, AKnownFactorIsNotLearnedTwice) {
  BiasLevel level(kConfigured_m_s);
  const double variance = 4 * kConfigured_m_s * kConfigured_m_s;
  for (int i = 0; i < 1000; ++i)
    level.learn(Eigen::Vector3d::Zero(), variance * Eigen::Matrix3d::Identity(), 4, 0.1);
  EXPECT_NEAR(std::sqrt(level.variance()), kConfigured_m_s, 1e-12);
}

TEST(BiasLevel, BeginsAnewAsConfigured) {
  BiasLevel level(kConfigured_m_s);
  level.learn(Eigen::Vector3d::Ones(), Eigen::Matrix3d::Zero(), 1, 10);
  EXPECT_NEAR(level.variance(), 1, 1e-12) << "longer than what is configured counts";
  level.reset();
  EXPECT_NEAR(level.variance(), kConfigured_m_s * kConfigured_m_s, 1e-15);
  level.learn(Eigen::Vector3d::Ones(), Eigen::Matrix3d::Zero(), 1, 2.5);
  EXPECT_NEAR(level.variance(), 0.5 * (1 + kConfigured_m_s * kConfigured_m_s), 1e-12);
}

TEST(BiasLevel, NoBiasIsLookedForWhenNoneIsConfigured) {
  BiasLevel level(0);
  level.learn(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 1, 10);
  EXPECT_EQ(level.variance(), 0);
}

}  // namespace
}  // namespace ardrone_vslam
