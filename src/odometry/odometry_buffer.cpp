// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_buffer.hpp"

#include <algorithm>
#include <sstream>

#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

bool isFinite(const OdometryState& state) {
  return state.T_odom_base.matrix().allFinite() && state.covariance.allFinite() &&
         state.twist_base.allFinite() && state.twist_covariance.allFinite();
}

std::int64_t toNanoseconds(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9);
}

/// As it is stored: what cannot be interpolated is taken out.
OdometryState bounded(OdometryState state) {
  if (!positionVariance_m2(state)) state.covariance.setZero();
  state.twist_covariance =
      state.twist_covariance.cwiseMax(-kLargestTwistCovariance).cwiseMin(kLargestTwistCovariance);
  return state;
}

}  // namespace

std::string rangeFault(const OdometryState& state) {
  std::ostringstream fault;
  const double fastest = state.twist_base.cwiseAbs().maxCoeff();
  if (!(farthest_m(state) <= kFarthestOdometry_m)) {
    fault << "its position has a coordinate of " << farthest_m(state) << " m, beyond "
          << kFarthestOdometry_m << " m; check its unit and whether its source has diverged";
  } else if (!(fastest <= kFastestOdometry)) {
    fault << "its twist has a component of " << fastest << ", beyond " << kFastestOdometry
          << " m/s or rad/s; check its unit, zeros stand for 'unknown'";
  }
  return fault.str();
}

double farthest_m(const OdometryState& state) {
  return state.T_odom_base.translation().cwiseAbs().maxCoeff();
}

bool isBeyondAllJumps(const OdometryState& message) {
  constexpr double kEpoch_s = 2e9;
  return !(farthest_m(message) <= kEpoch_s * kFastestOdometry);
}

std::optional<double> positionVariance_m2(const OdometryState& state) {
  const Eigen::Vector3d variance_m2 = state.covariance.diagonal().head<3>();
  const bool is_usable = variance_m2.minCoeff() >= 0 &&
                         variance_m2.maxCoeff() <= kLargestVariance_m2 && !variance_m2.isZero(0);
  if (!is_usable) return std::nullopt;
  return variance_m2.sum() / 3;
}

std::string covarianceFault(const OdometryState& state) {
  const Eigen::Vector3d variance_m2 = state.covariance.diagonal().head<3>();
  if (variance_m2.isZero(0) || positionVariance_m2(state)) return {};
  const bool is_negative = variance_m2.minCoeff() < 0;
  std::ostringstream fault;
  fault << "its position variance of "
        << (is_negative ? variance_m2.minCoeff() : variance_m2.maxCoeff()) << " m^2 is "
        << (is_negative ? "negative" : "above ");
  if (!is_negative) fault << kLargestVariance_m2 << " m^2";
  fault << ", so it counts as not given: the noise is that of odometry_noise_m_per_sqrt_m and "
           "odometry_noise_m_per_sqrt_s (MSCKF: walk_m_per_sqrt_m and _s); zeros in "
           "the source's pose covariance say the same";
  return fault.str();
}

OdometryState interpolate(const OdometryState& a, const OdometryState& b, std::int64_t stamp_ns) {
  const auto span = static_cast<double>(b.stamp_ns - a.stamp_ns);
  const double s = span > 0 ? static_cast<double>(stamp_ns - a.stamp_ns) / span : 0.0;
  OdometryState state;
  state.stamp_ns = stamp_ns;
  state.start = b.start;
  state.T_odom_base.linear() = rotationBetween(a.T_odom_base.linear(), b.T_odom_base.linear(), s);
  // In this form equal values stay equal to the bit: a covariance that does not grow must not seem
  // to grow by rounding.
  state.T_odom_base.translation() =
      a.T_odom_base.translation() + s * (b.T_odom_base.translation() - a.T_odom_base.translation());
  if (positionVariance_m2(a) && positionVariance_m2(b)) {
    state.covariance = a.covariance + s * (b.covariance - a.covariance);
  }
  state.twist_base = a.twist_base + s * (b.twist_base - a.twist_base);
  state.twist_covariance = a.twist_covariance + s * (b.twist_covariance - a.twist_covariance);
  return state;
}

OdometryBuffer::OdometryBuffer(const OdometryBufferConfig& config) : config_(config) {
  validate(config);
}

OdometryBuffer::Push OdometryBuffer::push(const OdometryState& state) {
  if (!isFinite(state)) return Push::kNotFinite;
  if (!rangeFault(state).empty()) return Push::kOutOfRange;
  if (!states_.empty()) {
    if (state.stamp_ns == states_.back().stamp_ns) return Push::kDuplicateStamp;
    if (state.stamp_ns < states_.back().stamp_ns) return Push::kBackwardStamp;
  }
  states_.push_back(bounded(state));
  const std::int64_t oldest_kept_ns = state.stamp_ns - toNanoseconds(config_.buffer_s);
  while (states_.front().stamp_ns < oldest_kept_ns) states_.pop_front();
  return Push::kAccepted;
}

OdometryBuffer::Lookup OdometryBuffer::at(std::int64_t stamp_ns, OdometryState& state) const {
  if (states_.empty()) return Lookup::kEmpty;
  if (stamp_ns < states_.front().stamp_ns) return Lookup::kTooOld;
  if (stamp_ns > states_.back().stamp_ns) return Lookup::kNotYet;
  const auto after =
      std::lower_bound(states_.begin(), states_.end(), stamp_ns,
                       [](const OdometryState& s, std::int64_t t) { return s.stamp_ns < t; });
  if (after->stamp_ns == stamp_ns) {
    state = *after;
    return Lookup::kFound;
  }
  const auto before = std::prev(after);
  if (after->stamp_ns - before->stamp_ns > toNanoseconds(config_.max_gap_s)) return Lookup::kGap;
  if (before->start != after->start) return Lookup::kGap;
  state = interpolate(*before, *after, stamp_ns);
  return Lookup::kFound;
}

}  // namespace ardrone_vslam
