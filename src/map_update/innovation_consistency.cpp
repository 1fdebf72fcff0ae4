// SPDX-License-Identifier: BSD-3-Clause
#include "map_update/innovation_consistency.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr int kCoordinates = 6;
constexpr double kShare = 0.1;  // of one fix in the means
constexpr double kWorst = 10;   // one fix counts no more
// The velocity's variance must grow by more than the fixes are off by: they see of it what has
// become of it since the last one.
constexpr double kGain = 3;

}  // namespace

void InnovationConsistency::learn(const Vector6d& whitened) {
  const double nis = whitened.squaredNorm() / kCoordinates;
  const double bounded = std::min(nis, kWorst);
  nis_ += kShare * (bounded - nis_);
  mean_ += kShare * ((nis > 0 ? std::sqrt(bounded / nis) : 1) * whitened - mean_);
}

double InnovationConsistency::common() const {
  return mean_.squaredNorm() / kCoordinates;
}

double InnovationConsistency::odometryFactor() const {
  return std::max(1.0, kGain * (2 * common() - nis_));
}

double InnovationConsistency::mapFactor() const {
  return std::max(1.0, nis_ - common());
}

}  // namespace ardrone_vslam
