// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_adapter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "odometry/message_pair.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr std::int64_t kRestart_ns = 1'000'000'000;   // stamps further back are a new run
constexpr std::int64_t kLongestGap_ns = 100'000'000;  // that a burst is spread over
constexpr double kLongestWay_s = 1;                   // across which the twist tells the way
/// The epoch in seconds at the fastest speed: beyond this lie no jumps, only nonsense.
constexpr double kFarthestJump_m = 2e9 * kFastestOdometry;
constexpr double kWholeMetreVariance_m2 = 1.0 / 12.0;  // of a metre cut off
// At which a whole metre corrects what the twist has climbed: not faster than a twist is wrong, or
// the camera contradicts it.
constexpr double kHeightRate_m_s = 0.03;

double farthest_m(const OdometryState& state) {
  return state.T_odom_base.translation().cwiseAbs().maxCoeff();
}

bool isFinite(const OdometryState& state) {
  return state.T_odom_base.matrix().allFinite() && state.twist_base.allFinite();
}

}  // namespace

OdometryAdapter::OdometryAdapter(const OdometryAdapterConfig& config) : config_(config) {
  validate(config);
}

bool OdometryAdapter::isBeyondAllJumps(const OdometryState& message) {
  return !(farthest_m(message) <= kFarthestJump_m);
}

void OdometryAdapter::beginAnew() {
  whole_metres_ = {};
  height_jumps_ = {};
  held_.reset();
  newest_ns_ = 0;
  last_.reset();
  candidate_.reset();
  position_odom_m_.setZero();
  offset_odom_m_.setZero();
  missing_twist_ = {};
}

Push OdometryAdapter::push(const OdometryState& message, std::vector<OdometryState>& ready) {
  if (!isFinite(message)) return Push::kNotFinite;
  if (!(message.twist_base.cwiseAbs().maxCoeff() <= kFastestOdometry) ||
      isBeyondAllJumps(message)) {
    return Push::kOutOfRange;
  }
  const bool is_first = newest_ns_ == 0;
  if (!is_first && message.stamp_ns <= newest_ns_ - kRestart_ns) {
    // Of navdata the DroneObserver has counted it.
    if (config_.mode != OdometryMode::kNavdata) count(OdometryFault::kRestart);
    beginAnew();
  } else if (!is_first && message.stamp_ns < newest_ns_) {
    return Push::kBackwardStamp;
  } else if (!is_first && message.stamp_ns == newest_ns_) {
    return addToBurst(message);
  }
  const Push answer = flush(ready);
  newest_ns_ = message.stamp_ns;
  if (!held_) return adapt(message, ready);
  held_->push_back(message);
  return answer;
}

Push OdometryAdapter::addToBurst(const OdometryState& message) {
  const bool is_held = held_ && !held_->empty();  // its first message
  const OdometryState* before = is_held ? &held_->back() : last_ ? &*last_ : nullptr;
  if (before && isRepeated(*before, message)) return Push::kDuplicateStamp;
  if (!held_ || held_->size() == 1) count(OdometryFault::kBurst);
  if (!is_held) {
    if (!held_) held_.emplace();  // the next one is held
    return absorb(message);
  }
  held_->push_back(message);
  return Push::kAccepted;
}

/// Of a burst whose first message has been given out already: no state of its own. The first one
/// counted for the whole gap before, of which all have equal shares.
Push OdometryAdapter::absorb(const OdometryState& message) {
  if (!last_ || last_->stamp_ns != message.stamp_ns || isJump(*last_, message)) {
    return Push::kDuplicateStamp;
  }
  const Eigen::Vector3d before_m_s = gap_.speeds_m_s / gap_.speed_count;
  gap_.speeds_m_s += 0.5 * (velocity_odom_m_s(*last_) + velocity_odom_m_s(message));
  ++gap_.speed_count;
  const Eigen::Vector3d missing_m =
      gap_.duration_s * (gap_.speeds_m_s / gap_.speed_count - before_m_s);
  if (gap_.duration_s == 0) {  // the very first burst
    position_odom_m_ = message.T_odom_base.translation() + offset_odom_m_;
  } else if (config_.mode == OdometryMode::kTwist) {
    position_odom_m_.head<2>() += missing_m.head<2>();
    if (config_.height == OdometryHeight::kTwist) position_odom_m_.z() += missing_m.z();
  }
  last_ = message;
  return Push::kAccepted;
}

Push OdometryAdapter::flush(std::vector<OdometryState>& ready) {
  Push answer = Push::kAccepted;
  if (!held_) return answer;
  const auto messages = static_cast<std::int64_t>(held_->size());
  for (std::int64_t i = 0; i < messages; ++i) {
    OdometryState& message = (*held_)[static_cast<std::size_t>(i)];
    if (last_) {
      const std::int64_t gap_ns = std::min(newest_ns_ - last_->stamp_ns, kLongestGap_ns);
      message.stamp_ns = newest_ns_ - gap_ns * (messages - 1 - i) / (messages - i);
    }
    const Push one = adapt(message, ready);
    if (one != Push::kAccepted) answer = one;
  }
  held_->clear();
  return answer;
}

/// Whether the message goes on from the one before, after what was to be repaired of it.
bool OdometryAdapter::follows(const OdometryState& message) {
  const bool is_jump = last_ ? isJump(*last_, message) : farthest_m(message) > kFarthestOdometry_m;
  if (!is_jump) {
    candidate_.reset();
    if (!last_ || !isReset(*last_, message)) return true;
    count(OdometryFault::kReset);
  } else {
    // One such message is nonsense, two that agree are a driver that goes on from there.
    const bool agrees = candidate_ && !isJump(*candidate_, message);
    candidate_ = message;
    if (!agrees) return false;
    candidate_.reset();
    count(OdometryFault::kJump);
  }
  const Eigen::Vector3d position_m = message.T_odom_base.translation();
  const Eigen::Vector3d expected_m = position_odom_m_ + wayByTwist_m(message);
  // Some drivers measure the height, which goes on by itself, and some integrate it, which does
  // not. Only what the twist cannot tell, across a hole or within a metre, is left to the message.
  const bool is_height_sane = std::abs(position_m.z() - position_odom_m_.z()) < kJump_m;
  const bool is_way_known = last_ && secondsBetween(*last_, message) <= kLongestWay_s;
  offset_odom_m_ = expected_m - position_m;
  if (is_height_sane && (!is_way_known || whole_metres_.isWhole())) offset_odom_m_.z() = 0;
  return true;
}

/// Since the last message, trapezoid; zero where it cannot be told.
Eigen::Vector3d OdometryAdapter::wayByTwist_m(const OdometryState& message) const {
  if (!last_) return Eigen::Vector3d::Zero();
  const double dt_s = secondsBetween(*last_, message);
  if (dt_s > kLongestWay_s) return Eigen::Vector3d::Zero();
  return 0.5 * dt_s * (velocity_odom_m_s(*last_) + velocity_odom_m_s(message));
}

/// By the twist, but within the metre that was cut off from the state's height.
double OdometryAdapter::heightByTwist_m(const OdometryState& state, double climb_m) const {
  const double foreseen_m = position_odom_m_.z() + climb_m;
  const double lowest_m = state.T_odom_base.translation().z();
  const double missing_m = std::clamp(foreseen_m, lowest_m, lowest_m + 1) - foreseen_m;
  const double most_m = kHeightRate_m_s * std::min(secondsBetween(*last_, state), kLongestWay_s);
  return foreseen_m + std::clamp(missing_m, -most_m, most_m);
}

/// The state goes on from the last answer, but for a height that is measured.
void OdometryAdapter::moveByTwist(const Eigen::Vector3d& way_m, OdometryState& state) {
  auto position_m = state.T_odom_base.translation();
  position_m.head<2>() = position_odom_m_.head<2>() + way_m.head<2>();
  if (config_.height == OdometryHeight::kTwist) {
    position_m.z() = position_odom_m_.z() + way_m.z();
  } else if (whole_metres_.isWhole()) {
    position_m.z() = heightByTwist_m(state, way_m.z());
  } else {
    if (height_jumps_.see(state.stamp_ns, position_m.z(), way_m.z()))
      count(OdometryFault::kTableStep);
    position_m.z() += height_jumps_.offset_m();
  }
}

Push OdometryAdapter::adapt(const OdometryState& message, std::vector<OdometryState>& ready) {
  const OdometryFaultCounts before = faults_;
  if (!follows(message)) return Push::kOutOfRange;
  const bool is_repaired = before != faults_;
  if (message.covariance.diagonal().head<3>().isZero(0)) count(OdometryFault::kNoCovariance);
  const Eigen::Vector3d way_m = wayByTwist_m(message);
  if (whole_metres_.see(message.T_odom_base.translation().z(), way_m.z()))
    count(OdometryFault::kWholeMetres);

  OdometryState state = message;
  if (!offset_odom_m_.isZero(0)) state.T_odom_base.translation() += offset_odom_m_;
  if (config_.mode == OdometryMode::kTwist && last_) {
    if (secondsBetween(*last_, message) > kLongestWay_s) count(OdometryFault::kHole);
    const bool is_twist_zero = message.twist_base.head<3>().isZero(0);
    if (!is_repaired && missing_twist_.see(is_twist_zero, wayBetween_m(*last_, message).norm()))
      count(OdometryFault::kNoTwist);
    moveByTwist(way_m, state);
  }
  if (whole_metres_.isWhole() && positionVariance_m2(state)) {
    state.covariance(2, 2) += kWholeMetreVariance_m2;
  }
  gap_ = {last_ ? std::min(secondsBetween(*last_, message), kLongestWay_s) : 0,
          0.5 * (velocity_odom_m_s(last_ ? *last_ : message) + velocity_odom_m_s(message)), 1};
  last_ = message;
  position_odom_m_ = state.T_odom_base.translation();
  ready.push_back(std::move(state));
  return Push::kAccepted;
}

}  // namespace ardrone_vslam
