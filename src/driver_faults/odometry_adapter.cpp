// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/odometry_adapter.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "driver_faults/height_jumps.hpp"
#include "driver_faults/message_pair.hpp"
#include "driver_faults/missing_twist.hpp"
#include "driver_faults/odom_frame_watch.hpp"
#include "driver_faults/whole_metres.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr std::int64_t kRestart_ns = 1'000'000'000;   // stamps further back are a new run
constexpr std::int64_t kLongestGap_ns = 100'000'000;  // that a burst is spread over
constexpr double kLongestStep_s = 1;  // across which the twist tells the displacement
constexpr double kWholeMetreVariance_m2 = 1.0 / 12.0;  // of a metre cut off

bool isMotionFinite(const OdometryState& state) {
  return state.T_odom_base.matrix().allFinite() && state.twist_base.allFinite();
}

}  // namespace

class OdometryAdapter::State {
 public:
  explicit State(const OdometryAdapterConfig& config) : config_(config) { validate(config); }
  Push push(const OdometryState& raw, std::vector<OdometryState>& ready);
  Push flush(std::vector<OdometryState>& ready);
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void beginAnew();
  Push addToBurst(const OdometryState& message);
  Push absorb(const OdometryState& message);
  Push adapt(const OdometryState& message, std::vector<OdometryState>& ready);
  bool follows(const OdometryState& message);
  Eigen::Vector3d displacementByTwist_m(const OdometryState& message) const;
  void moveByTwist(const Eigen::Vector3d& by_twist_m, OdometryState& state);

  struct Answer {
    Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();  // the last one
    Eigen::Vector3d offset_odom_m = Eigen::Vector3d::Zero();    // from the messages
  };
  /// What became of the time before a message.
  struct Gap {
    double duration_s = 0;
    Eigen::Vector3d speeds_m_s = Eigen::Vector3d::Zero();  // sum of the mean speeds in it
    int speed_count = 1;
  };

  OdometryAdapterConfig config_;
  OdometryFaultCounts faults_{};
  WholeMetresWatch whole_metres_;
  MissingTwistWatch missing_twist_;
  HeightJumpDetector height_jumps_;  // odometry_mode twist with the pose's height
  OdomFrameWatch frame_watch_;

  // Messages of one stamp, of which there may be more; there from the first burst on.
  std::optional<std::vector<OdometryState>> held_;
  std::int64_t newest_ns_ = 0;              // of the messages; 0: none
  std::optional<OdometryState> last_;       // message that was used, its stamp spread
  std::optional<OdometryState> candidate_;  // message that jumped, until one agrees with it
  Answer answer_;
  Gap gap_;  // before last_, should it be the first of a burst
};

/// All but the counts, and the starts that were seen.
void OdometryAdapter::State::beginAnew() {
  State anew(config_);
  anew.faults_ = faults_;
  anew.frame_watch_ = frame_watch_;
  *this = std::move(anew);
}

Push OdometryAdapter::State::push(const OdometryState& raw, std::vector<OdometryState>& ready) {
  if (!isMotionFinite(raw)) return Push::kNotFinite;
  if (!(raw.twist_base.cwiseAbs().maxCoeff() <= kFastestOdometry) || isBeyondAllJumps(raw))
    return Push::kOutOfRange;
  const bool is_first = newest_ns_ == 0;
  if (!is_first && raw.stamp_ns <= newest_ns_ - kRestart_ns) {
    // Of navdata the DroneObserver has counted it.
    if (config_.mode != OdometryMode::kNavdata) count(OdometryFault::kRestart);
    beginAnew();
  } else if (!is_first && raw.stamp_ns < newest_ns_) {
    return Push::kBackwardStamp;
  }
  const std::uint32_t start = frame_watch_.start();
  if (const auto fault = frame_watch_.see(raw)) count(*fault);
  const OdometryState message = frame_watch_.straightened(raw);
  const bool is_new_start = message.start != start;
  if (!is_first && !is_new_start && message.stamp_ns == newest_ns_) return addToBurst(message);
  const Push answer = flush(ready);
  if (is_new_start) beginAnew();
  newest_ns_ = message.stamp_ns;
  if (!held_) return adapt(message, ready);
  held_->push_back(message);
  return answer;
}

Push OdometryAdapter::State::addToBurst(const OdometryState& message) {
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
Push OdometryAdapter::State::absorb(const OdometryState& message) {
  if (!last_ || last_->stamp_ns != message.stamp_ns || isJump(*last_, message)) {
    return Push::kDuplicateStamp;
  }
  const Eigen::Vector3d before_m_s = gap_.speeds_m_s / gap_.speed_count;
  gap_.speeds_m_s += 0.5 * (velocity_odom_m_s(*last_) + velocity_odom_m_s(message));
  ++gap_.speed_count;
  const Eigen::Vector3d missing_m =
      gap_.duration_s * (gap_.speeds_m_s / gap_.speed_count - before_m_s);
  if (gap_.duration_s == 0) {  // the very first burst
    answer_.position_odom_m = message.T_odom_base.translation() + answer_.offset_odom_m;
  } else if (config_.mode == OdometryMode::kTwist) {
    answer_.position_odom_m.head<2>() += missing_m.head<2>();
    if (config_.height == OdometryHeight::kTwist) answer_.position_odom_m.z() += missing_m.z();
  }
  last_ = message;
  return Push::kAccepted;
}

Push OdometryAdapter::State::flush(std::vector<OdometryState>& ready) {
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
bool OdometryAdapter::State::follows(const OdometryState& message) {
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
  const Eigen::Vector3d expected_m = answer_.position_odom_m + displacementByTwist_m(message);
  // Some drivers measure the height, which goes on by itself, and some integrate it, which does
  // not. Only what the twist cannot tell, across a hole or within a metre, is left to the message.
  const bool is_height_sane = std::abs(position_m.z() - answer_.position_odom_m.z()) < kJump_m;
  const bool is_displacement_known = last_ && secondsBetween(*last_, message) <= kLongestStep_s;
  answer_.offset_odom_m = expected_m - position_m;
  if (is_height_sane && (!is_displacement_known || whole_metres_.isWhole()))
    answer_.offset_odom_m.z() = 0;
  return true;
}

/// Since the last message, trapezoid; zero where it cannot be told.
Eigen::Vector3d OdometryAdapter::State::displacementByTwist_m(const OdometryState& message) const {
  if (!last_) return Eigen::Vector3d::Zero();
  const double dt_s = secondsBetween(*last_, message);
  if (dt_s > kLongestStep_s) return Eigen::Vector3d::Zero();
  return 0.5 * dt_s * (velocity_odom_m_s(*last_) + velocity_odom_m_s(message));
}

/// The state goes on from the last answer, but for a height that is measured.
void OdometryAdapter::State::moveByTwist(const Eigen::Vector3d& by_twist_m, OdometryState& state) {
  auto position_m = state.T_odom_base.translation();
  position_m.head<2>() = answer_.position_odom_m.head<2>() + by_twist_m.head<2>();
  if (config_.height == OdometryHeight::kTwist) {
    position_m.z() = answer_.position_odom_m.z() + by_twist_m.z();
  } else if (whole_metres_.isWhole()) {
    const double dt_s = std::min(secondsBetween(*last_, state), kLongestStep_s);
    position_m.z() =
        smoothedHeight_m(position_m.z(), answer_.position_odom_m.z() + by_twist_m.z(), dt_s);
  } else {
    if (height_jumps_.see(state.stamp_ns, position_m.z(), by_twist_m.z()))
      count(OdometryFault::kTableStep);
    position_m.z() += height_jumps_.offset_m();
  }
}

Push OdometryAdapter::State::adapt(const OdometryState& message,
                                   std::vector<OdometryState>& ready) {
  const OdometryFaultCounts before = faults_;
  if (!follows(message)) return Push::kOutOfRange;
  const bool is_repaired = before != faults_;
  if (message.covariance.diagonal().head<3>().isZero(0)) count(OdometryFault::kNoCovariance);
  const Eigen::Vector3d by_twist_m = displacementByTwist_m(message);
  if (whole_metres_.see(message.T_odom_base.translation().z(), by_twist_m.z()))
    count(OdometryFault::kWholeMetres);

  OdometryState state = message;
  if (!answer_.offset_odom_m.isZero(0)) state.T_odom_base.translation() += answer_.offset_odom_m;
  if (config_.mode == OdometryMode::kTwist && last_) {
    if (secondsBetween(*last_, message) > kLongestStep_s) count(OdometryFault::kHole);
    const bool is_twist_zero = message.twist_base.head<3>().isZero(0);
    if (!is_repaired &&
        missing_twist_.see(is_twist_zero, displacementBetween_m(*last_, message).norm()))
      count(OdometryFault::kNoTwist);
    moveByTwist(by_twist_m, state);
  }
  if (whole_metres_.isWhole() && positionVariance_m2(state)) {
    state.covariance(2, 2) += kWholeMetreVariance_m2;
  }
  gap_ = {last_ ? std::min(secondsBetween(*last_, message), kLongestStep_s) : 0,
          0.5 * (velocity_odom_m_s(last_ ? *last_ : message) + velocity_odom_m_s(message)), 1};
  last_ = message;
  answer_.position_odom_m = state.T_odom_base.translation();
  ready.push_back(std::move(state));
  return Push::kAccepted;
}

OdometryAdapter::OdometryAdapter(const OdometryAdapterConfig& config)
    : state_(std::make_unique<State>(config)) {}
OdometryAdapter::~OdometryAdapter() = default;

Push OdometryAdapter::push(const OdometryState& message, std::vector<OdometryState>& ready) {
  return state_->push(message, ready);
}

Push OdometryAdapter::flush(std::vector<OdometryState>& ready) {
  return state_->flush(ready);
}

const OdometryFaultCounts& OdometryAdapter::faults() const {
  return state_->faults();
}

}  // namespace ardrone_vslam
