// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry_step.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "ardrone_vslam/frame_result.hpp"
#include "linear/portable_math.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kMemory_s = 0.1;          // the velocity's
constexpr double kAcceleration_m_s2 = 10;  // more than a camera drone's
constexpr double kSlack_m = 0.25;          // noise of positions
constexpr double kStampSlack = 0.5;        // of the way: stamps jitter by a share of their interval
constexpr double kSigmas = 5;              // by the odometry's own covariance
constexpr double kFrozen_m = 1e-9;         // less than any odometry moves in flight
constexpr double kFlying_m_s = 0.3;        // nothing stops at once
constexpr double kShortestFreeze_s = 0.5;  // a message may come twice
constexpr double kLongestFreeze_s = 10;    // then the whole map is in question anyway

double growth_m2(const OdometryState& from, const OdometryState& to) {
  const auto then = positionVariance_m2(from);
  const auto now = positionVariance_m2(to);
  return then && now ? std::max(*now - *then, 0.0) : 0;
}

}  // namespace

std::optional<OdometryStep> OdometryStepWatch::see(const OdometryState& state) {
  const OdometryState last = last_;
  const bool is_first = !has_last_;
  last_ = state;
  has_last_ = true;
  const double dt_s = seconds(state.stamp_ns - last.stamp_ns);
  if (is_first || !(dt_s > 0)) return std::nullopt;
  const Eigen::Vector3d displacement_m =
      state.T_odom_base.translation() - last.T_odom_base.translation();
  const double speed_m_s = velocity_odom_m_s_.norm();
  if (displacement_m.norm() < kFrozen_m && speed_m_s > kFlying_m_s) {
    frozen_s_ += dt_s;
    return std::nullopt;
  }
  const double lost_m = frozenWay_m();
  frozen_s_ = 0;
  const Eigen::Vector3d expected_m = velocity_odom_m_s_ * dt_s;
  const double most_m = kSlack_m + kStampSlack * expected_m.norm() +
                        kAcceleration_m_s2 * (kMemory_s + stepping_s_ + dt_s) * dt_s +
                        kSigmas * std::sqrt(growth_m2(last, state));
  const Eigen::Vector3d excess_m = displacement_m - expected_m;
  // A way no longer than the speed explains is none: a car may stop, or a recording turn round.
  const bool is_long = displacement_m.norm() > expected_m.norm() + most_m;
  const bool is_other = excess_m.norm() > most_m;
  if (has_velocity_ && stepping_s_ < kLongest_s && is_other && is_long) {
    stepping_s_ += dt_s;
    return OdometryStep{expected_m, excess_m, most_m / 3};
  }
  const bool is_anew = !has_velocity_ || is_other;
  const double share = is_anew ? 1 : 1 - portable::exp(-dt_s / kMemory_s);
  velocity_odom_m_s_ += share * (displacement_m / dt_s - velocity_odom_m_s_);
  has_velocity_ = true;
  stepping_s_ = 0;
  // The way may have gone on as before, and the attitude is right again only now.
  if (lost_m > 0) return OdometryStep{displacement_m, Eigen::Vector3d::Zero(), lost_m};
  return std::nullopt;
}

double OdometryStepWatch::frozenWay_m() const {
  if (frozen_s_ < kShortestFreeze_s) return 0;
  return velocity_odom_m_s_.norm() * std::min(frozen_s_, kLongestFreeze_s);
}

std::string explainStep(const std::string& odometry, double step_m) {
  std::ostringstream text;
  text.precision(2);
  text << odometry << " stepped by " << step_m
       << " m between two images, which no motion explains: it may drift, but it must not jump; "
          "check whether its source resets its position or writes corrections (map to odom, GPS, "
          "sonar over furniture) back into it";
  return text.str();
}

}  // namespace ardrone_vslam
