// SPDX-License-Identifier: BSD-3-Clause
#include "noise/bias_level.hpp"

#include <algorithm>

#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kConfigured_s = 5;  // what is configured counts as so much time

}  // namespace

BiasLevel::BiasLevel(double configured_m_s)
    : configured_variance_(squared(configured_m_s)), variance_(configured_variance_) {}

void BiasLevel::learn(const Eigen::Vector3d& bias_m_s, const Eigen::Matrix3d& covariance,
                      double inflation, double duration_s) {
  const double seen = (bias_m_s.squaredNorm() + covariance.trace()) / 3 / inflation;
  const double memory_s = std::min(kConfigured_s + learned_s_, kNoiseMemory_s);
  variance_ += std::min(duration_s / memory_s, 1.0) * (seen - variance_);
  learned_s_ += duration_s;
}

void BiasLevel::reset() {
  variance_ = configured_variance_;
  learned_s_ = 0;
}

}  // namespace ardrone_vslam
