// SPDX-License-Identifier: BSD-3-Clause
#include "driver_faults/odom_frame_watch.hpp"

#include <cmath>

#include "ardrone_vslam/rotation.hpp"
#include "driver_faults/message_pair.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kSlack_rad = 0.3;
constexpr double kAcceleration_rad_s2 = 4;  // the rate of turning may change so fast
constexpr double kBurst_s = 0.1;            // stamps may be wrong by so much
constexpr double kShortestStep_s = 0.004;   // that tells a rate
// Between two jumps so far apart the odometry was another one's; nearer, a message was nonsense.
constexpr double kShortestOther_s = 0.5;
constexpr double kLongestOther_s = 60;

}  // namespace

std::optional<OdometryFault> OdomFrameWatch::see(const OdometryState& message) {
  const OdometryState last = last_.value_or(message);
  last_ = message;
  const double dt_s = secondsBetween(last, message);
  if (dt_s < 0) {  // time itself began anew
    T_straight_odom_.setIdentity();
    moved_ = message;
    return std::nullopt;
  }
  if (isStartedAgain(last, message)) {
    beginAnew();
    return OdometryFault::kStartedAgain;
  }
  const double turn_rad = turnBetween_rad(last, message);
  // A stream that was frozen catches up.
  const double moving_s = secondsBetween(moved_.value_or(message), message);
  if (!moved_ || message.T_odom_base.matrix() != last.T_odom_base.matrix()) moved_ = message;
  // The twist may be in other units or empty, stamps may lie too near: any rate that explains it.
  double jump_rad = 2 * M_PI;
  for (const double rate_rad_s :
       {0.5 * (last.twist_base[5] + message.twist_base[5]), rate_rad_s_, 0.0}) {
    const double off_rad = std::remainder(turn_rad - rate_rad_s * dt_s, 2 * M_PI);
    const double most_rad =
        kSlack_rad + kAcceleration_rad_s2 * moving_s * moving_s + kBurst_s * std::abs(rate_rad_s);
    if (std::abs(off_rad) <= most_rad) {
      if (dt_s > kShortestStep_s) rate_rad_s_ = turn_rad / dt_s;
      return std::nullopt;
    }
    if (std::abs(off_rad) < std::abs(jump_rad)) jump_rad = off_rad;
  }
  const double since_jump_s = jump_ ? secondsBetween(*jump_, message) : kLongestOther_s;
  jump_ = message;
  if (since_jump_s <= kShortestOther_s) {
    jump_.reset();
  } else if (since_jump_s < kLongestOther_s) {
    beginAnew();
    return OdometryFault::kTurn;
  }
  const Eigen::Vector3d way_base_m = 0.5 * dt_s * (last.twist_base + message.twist_base).head<3>();
  const Eigen::Vector3d told_m = message.T_odom_base.translation();
  Eigen::Vector3d position_m = T_straight_odom_ * last.T_odom_base * way_base_m;
  position_m.z() = told_m.z();  // drivers measure it
  T_straight_odom_.linear() = rotationAboutZ(-jump_rad) * T_straight_odom_.linear();
  T_straight_odom_.translation() = position_m - T_straight_odom_.linear() * told_m;
  return OdometryFault::kTurn;
}

void OdomFrameWatch::beginAnew() {
  T_straight_odom_.setIdentity();
  jump_.reset();
  ++start_;
}

OdometryState OdomFrameWatch::straightened(const OdometryState& message) const {
  OdometryState state = message;
  state.start = start_;
  state.T_odom_base = T_straight_odom_ * message.T_odom_base;
  return state;
}

}  // namespace ardrone_vslam
