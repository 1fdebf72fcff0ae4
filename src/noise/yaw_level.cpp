// SPDX-License-Identifier: BSD-3-Clause
#include "noise/yaw_level.hpp"

#include <algorithm>
#include <limits>

#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"
#include "noise/bias_level.hpp"

namespace ardrone_vslam {
namespace {

// Factors on the variance are powers of two, half an exponent apart. Beforehand 1 is the most
// probable one, and the others as the exponent's upper half of a normal distribution: with a larger
// sigma one odd second counts, with a smaller one a bad odometry is believed for long.
constexpr double kStep = 0.5;
constexpr double kExponentSigma = 1.5;
// Student's t: of some pairs the image's own error is far larger than it claims.
constexpr double kDegreesOfFreedom = 5;
// Lenses and clocks that are not quite as told look like yaw that is up to twice as bad.
constexpr double kLeastFactor = 4;  // of the variance

}  // namespace

double YawLevel::configuredWalk_rad2(double time_s, double displacement_m) const {
  return squared(radians(config_.yaw_walk_deg_per_sqrt_s)) * time_s +
         squared(radians(config_.yaw_walk_deg_per_sqrt_m)) * displacement_m;
}

void YawLevel::learn(const SetupFinding& finding) {
  const SeenYaw& yaw = finding.yaw;
  if (!(yaw.span_s > 0) || yaw.stamp_ns == learned_ns_) return;
  if (finding.fault != SetupFault::kNone) return;
  // Pairs overlap: of each counts what lies behind the one before.
  const double new_s = std::clamp(seconds(yaw.stamp_ns - learned_ns_), 0.0, yaw.span_s);
  learned_ns_ = yaw.stamp_ns;
  const double walk_rad2 = configuredWalk_rad2(yaw.span_s, yaw.displacement_m);
  const double rest_rad2 = yaw.variance_rad2 + 2 * squared(radians(config_.attitude_noise_deg));
  const double kept = portable::exp(-new_s / kNoiseMemory_s);
  double most = -std::numeric_limits<double>::infinity();
  double most_probable = 1;
  for (std::size_t i = 0; i < kFactors; ++i) {
    const double exponent = kStep * static_cast<double>(i);
    const double variance_rad2 = portable::exp(M_LN2 * exponent) * walk_rad2 + rest_rad2;
    const double squares = squared(yaw.off_rad) / variance_rad2;
    const double log_density =
        -0.5 * (portable::log(variance_rad2) +
                (kDegreesOfFreedom + 1) * portable::log1p(squares / kDegreesOfFreedom));
    log_likelihood_[i] = kept * log_likelihood_[i] + new_s / yaw.span_s * log_density;
    const double log_posterior = log_likelihood_[i] - 0.5 * squared(exponent / kExponentSigma);
    if (log_posterior <= most) continue;
    most = log_posterior;
    most_probable = portable::exp(M_LN2 * exponent);
  }
  variance_factor_ = most_probable < kLeastFactor ? 1 : most_probable;
}

}  // namespace ardrone_vslam
