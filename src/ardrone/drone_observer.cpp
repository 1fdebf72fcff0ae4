// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/drone_observer.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone/commanded_flight.hpp"
#include "ardrone/drone_observer_state.hpp"
#include "ardrone_vslam/rotation.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr std::int64_t kRestart_ns = 1'000'000'000;   // stamps further back are a new run
constexpr std::int64_t kLongestGap_ns = 100'000'000;  // that packets are spread over
constexpr double kStep_s = 0.02;                      // of the integration
constexpr double kHole_s = 0.1;                       // in which nobody knows what was done
constexpr double kCommandsKept_s = 5;
constexpr double kCommandHolds_s = 0.5;  // the drone hovers when it is told nothing for longer
constexpr double kRadPerDeg = M_PI / 180;
constexpr double kCommandTime_s = 0.12;  // in which roll and pitch follow, twice over
constexpr double kLongestHole_s = 1;     // as the OdometryAdapter's
constexpr double kLostSpeed_m_s = 1;     // that a drone may have flown at beyond it
constexpr double kTurnNoise_rad_s = 0.01;
constexpr double kLargestForce_m_s2 = 1e3;
constexpr double kHighest_m = 1e4;
constexpr double kYawJump_rad = 0.5;
constexpr double kFastestTurn_rad_s = 6;

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1e-9;
}

double yawOf(const Eigen::Matrix3d& R) {
  return std::atan2(R(1, 0), R(0, 0));
}

Push check(const DroneMeasurement& m) {
  if (!m.R_odom_base.allFinite() || !m.flow_base_m_s.allFinite() ||
      !m.force_base_m_s2.allFinite() || !std::isfinite(m.height_m)) {
    return Push::kNotFinite;
  }
  const bool is_in_range = m.flow_base_m_s.cwiseAbs().maxCoeff() <= kFastestOdometry &&
                           m.force_base_m_s2.cwiseAbs().maxCoeff() <= kLargestForce_m_s2 &&
                           m.height_m <= kHighest_m;
  return is_in_range ? Push::kAccepted : Push::kOutOfRange;
}

Push check(const DroneImu& imu) {
  if (!imu.turn_rate_base_rad_s.allFinite() || !imu.force_base_m_s2.allFinite()) {
    return Push::kNotFinite;
  }
  const bool is_in_range = imu.turn_rate_base_rad_s.cwiseAbs().maxCoeff() <= kFastestOdometry &&
                           imu.force_base_m_s2.cwiseAbs().maxCoeff() <= kLargestForce_m_s2;
  return is_in_range ? Push::kAccepted : Push::kOutOfRange;
}

/// Between two packets.
DroneMeasurement between(const DroneMeasurement& a, const DroneMeasurement& b, double share) {
  DroneMeasurement m = b;
  m.R_odom_base = a.R_odom_base *
                  rotationOf(share * rotationVectorOf(a.R_odom_base.transpose() * b.R_odom_base));
  m.force_base_m_s2 += (1 - share) * (a.force_base_m_s2 - b.force_base_m_s2);
  return m;
}

}  // namespace

DroneObserver::State::State(const DroneFilterConfig& config) : config_(config) {
  validate(config);
}

void DroneObserver::State::beginAnew() {
  packets_.clear();
  imu_.clear();
  commands_.clear();
  newest_imu_ns_ = newest_packet_ns_ = last_group_ns_ = 0;
  last_.reset();
  floor_.clear();
  yaw_offset_rad_ = 0;
}

Push DroneObserver::State::push(const NavdataReading& packet, std::vector<OdometryState>& ready) {
  const Push answer = check(packet.measured);
  if (answer != Push::kAccepted) return answer;
  if (newest_packet_ns_ != 0 && packet.stamp_ns <= newest_packet_ns_ - kRestart_ns) {
    count(OdometryFault::kRestart);
    const bool imu_is_new = newest_imu_ns_ <= newest_packet_ns_ - kRestart_ns;
    std::deque<DroneImu> imu;
    if (imu_is_new) imu.swap(imu_);  // it was there first
    const std::int64_t newest_imu_ns = imu_is_new ? newest_imu_ns_ : 0;
    beginAnew();
    imu_.swap(imu);
    newest_imu_ns_ = newest_imu_ns;
  } else if (packet.stamp_ns < newest_packet_ns_) {
    return Push::kBackwardStamp;
  }
  newest_packet_ns_ = packet.stamp_ns;
  packets_.push_back(packet);
  release(ready);
  return Push::kAccepted;
}

Push DroneObserver::State::push(const DroneImu& imu, std::vector<OdometryState>& ready) {
  const Push answer = check(imu);
  if (answer != Push::kAccepted) return answer;
  if (newest_imu_ns_ != 0 && imu.stamp_ns <= newest_imu_ns_ - kRestart_ns) {
    imu_.clear();
  } else if (imu.stamp_ns < newest_imu_ns_) {
    return Push::kBackwardStamp;
  }
  newest_imu_ns_ = imu.stamp_ns;
  imu_.push_back(imu);
  while (seconds(imu.stamp_ns - imu_.front().stamp_ns) > kLongestHole_s) imu_.pop_front();
  release(ready);
  return Push::kAccepted;
}

Push DroneObserver::State::push(const DroneCommandReading& command) {
  if (!command.tilt.allFinite()) return Push::kNotFinite;
  if (!commands_.empty() && command.stamp_ns < commands_.back().stamp_ns) commands_.clear();
  commands_.push_back(command);
  while (seconds(command.stamp_ns - commands_.front().stamp_ns) > kCommandsKept_s) {
    commands_.pop_front();
  }
  return Push::kAccepted;
}

void DroneObserver::State::flush(std::vector<OdometryState>& ready) {
  while (!packets_.empty()) releaseFirst(ready);
}

void DroneObserver::State::release(std::vector<OdometryState>& ready) {
  while (!packets_.empty()) {
    const std::int64_t first_ns = packets_.front().stamp_ns;
    const bool is_whole = newest_packet_ns_ > first_ns;
    const bool has_imu =
        newest_imu_ns_ > first_ns || newest_packet_ns_ - first_ns >= kLongestWait_ns;
    if (!is_whole || !has_imu) return;
    releaseFirst(ready);
  }
}

/// All packets of the oldest stamp.
void DroneObserver::State::releaseFirst(std::vector<OdometryState>& ready) {
  const std::int64_t stamp_ns = packets_.front().stamp_ns;
  std::vector<NavdataReading> group;
  for (; !packets_.empty() && packets_.front().stamp_ns == stamp_ns; packets_.pop_front()) {
    group.push_back(packets_.front());
  }
  std::vector<Eigen::Vector3d> turn_rates;
  takeImu(group, turn_rates);
  const auto messages = static_cast<std::int64_t>(group.size());
  if (messages > 1) count(OdometryFault::kBurst);
  const std::int64_t gap_ns =
      last_group_ns_ == 0 ? 0 : std::min(stamp_ns - last_group_ns_, kLongestGap_ns);
  last_group_ns_ = stamp_ns;
  for (std::int64_t i = 0; i < messages; ++i) {
    const auto k = static_cast<std::size_t>(i);
    group[k].stamp_ns = stamp_ns - gap_ns * (messages - 1 - i) / messages;
    if (last_ && group[k].stamp_ns <= last_->stamp_ns) continue;  // the very first ones
    ready.push_back(advance(group[k]));
    if (turn_rates.empty()) continue;
    ready.back().twist_base.tail<3>() = turn_rates[k];
    ready.back().twist_covariance.diagonal().tail<3>().setConstant(kTurnNoise_rad_s *
                                                                   kTurnNoise_rad_s);
  }
}

/// Puts the IMU's readings up to the packets' stamp into the packets: one each, or else their mean
/// into all.
void DroneObserver::State::takeImu(std::vector<NavdataReading>& packets,
                                   std::vector<Eigen::Vector3d>& turn_rates) {
  std::vector<DroneImu> readings;
  for (; !imu_.empty() && imu_.front().stamp_ns <= packets.front().stamp_ns; imu_.pop_front()) {
    if (imu_.front().stamp_ns > last_group_ns_) readings.push_back(imu_.front());
  }
  if (readings.empty()) return;
  if (readings.size() != packets.size()) {
    DroneImu mean = readings.front();
    const auto share = 1 / static_cast<double>(readings.size());
    mean.turn_rate_base_rad_s.setZero();
    mean.force_base_m_s2.setZero();
    for (const DroneImu& reading : readings) {
      mean.turn_rate_base_rad_s += share * reading.turn_rate_base_rad_s;
      mean.force_base_m_s2 += share * reading.force_base_m_s2;
    }
    readings.assign(packets.size(), mean);
  }
  for (std::size_t i = 0; i < packets.size(); ++i) {
    packets[i].measured.force_base_m_s2 = readings[i].force_base_m_s2;
    turn_rates.push_back(readings[i].turn_rate_base_rad_s);
  }
}

OdometryState DroneObserver::State::advance(NavdataReading packet) {
  if (!last_) {
    filter_.begin(packet.measured);
    first_ns_ = packet.stamp_ns;
  } else {
    const double dt_s = seconds(packet.stamp_ns - last_->stamp_ns);
    keepYaw(packet, dt_s);
    if (dt_s > kLongestHole_s) count(OdometryFault::kHole);
    if (packet.is_standing && last_->is_standing) {
      filter_.rest(std::min(dt_s, kLongestHole_s));
    } else {
      fly(packet, dt_s);
    }
  }
  last_ = packet;
  OdometryState state = filter_.observed(packet.measured.R_odom_base);
  state.stamp_ns = packet.stamp_ns;
  return state;
}

/// A drone that was switched on anew reports another yaw: odom stays where it was.
void DroneObserver::State::keepYaw(NavdataReading& packet, double dt_s) {
  Eigen::Matrix3d& R = packet.measured.R_odom_base;
  R = Eigen::AngleAxisd(yaw_offset_rad_, Eigen::Vector3d::UnitZ()) * R;
  const double rotation_rad =
      std::remainder(yawOf(R) - yawOf(last_->measured.R_odom_base), 2 * M_PI);
  if (std::abs(rotation_rad) <= kYawJump_rad + kFastestTurn_rad_s * dt_s) return;
  count(OdometryFault::kReset);
  yaw_offset_rad_ -= rotation_rad;
  R = Eigen::AngleAxisd(-rotation_rad, Eigen::Vector3d::UnitZ()) * R;
}

void DroneObserver::State::fly(const NavdataReading& packet, double dt_s) {
  const double flown_s = std::min(dt_s, kLongestHole_s);
  if (dt_s > kHole_s) {
    bridge(packet, flown_s);
  } else {
    const int steps = static_cast<int>(std::ceil(flown_s / kStep_s - 1e-9));
    for (int i = 0; i < steps; ++i) {
      filter_.predict(between(last_->measured, packet.measured, (i + 0.5) / steps),
                      flown_s / steps);
    }
  }
  const double lost_s = dt_s - flown_s;
  if (lost_s > 0) filter_.widen(kLostSpeed_m_s * lost_s, kLostSpeed_m_s);
  if (!packet.is_standing) filter_.updateVelocity(packet.measured, dt_s);
  if (packet.measured.height_m > 0) useHeight(packet, dt_s);
}

/// Across a hole, by what the drone was told; where that is unknown, too, from one attitude to the
/// other.
void DroneObserver::State::bridge(const NavdataReading& packet, double flown_s) {
  using Known = DroneFilter::Known;
  const std::int64_t oldest_ns = last_->stamp_ns - std::llround(kCommandHolds_s * 1e9);
  auto next = std::find_if(commands_.begin(), commands_.end(),
                           [&](const DroneCommandReading& c) { return c.stamp_ns >= oldest_ns; });
  const bool is_told = next != commands_.end() && next->stamp_ns < packet.stamp_ns;
  CommandedFlight commanded(last_->measured, config_.command_tilt_deg * kRadPerDeg, kCommandTime_s);
  const int steps = static_cast<int>(std::ceil(flown_s / kStep_s - 1e-9));
  const double dt_s = flown_s / steps;
  DroneCommandReading command{oldest_ns, Eigen::Vector2d::Zero()};
  for (int i = 0; i < steps; ++i) {
    const DroneMeasurement guessed = between(last_->measured, packet.measured, (i + 0.5) / steps);
    if (!is_told) {
      filter_.predict(guessed, dt_s, Known::kInterpolated);
      continue;
    }
    const std::int64_t now_ns = last_->stamp_ns + std::llround((i + 0.5) * dt_s * 1e9);
    for (; next != commands_.end() && next->stamp_ns <= now_ns; ++next) command = *next;
    if (seconds(now_ns - command.stamp_ns) > kCommandHolds_s) command.tilt.setZero();
    filter_.predict(commanded.step(command.tilt, filter_.state().segment<3>(drone_model::kVelocity),
                                   yawOf(guessed.R_odom_base), dt_s),
                    dt_s, Known::kCommanded);
  }
}

void DroneObserver::State::useHeight(const NavdataReading& packet, double dt_s) {
  const double height_m = packet.measured.height_m;
  const double z_m = filter_.state()[drone_model::kPosition + 2];
  switch (floor_.see(seconds(packet.stamp_ns - first_ns_), filter_.heightInnovation_m(height_m),
                     filter_.heightSigma_m(), z_m - height_m)) {
    case FloorWatch::Answer::kSame:
      return filter_.updateHeight(height_m, dt_s);
    case FloorWatch::Answer::kWait:
      return;
    case FloorWatch::Answer::kOther:
      count(OdometryFault::kTableStep);
      return filter_.changeFloor(floor_.floor_m());
  }
}

DroneObserver::DroneObserver(const DroneFilterConfig& config)
    : state_(std::make_unique<State>(config)) {}

DroneObserver::~DroneObserver() = default;
DroneObserver::DroneObserver(DroneObserver&&) noexcept = default;
DroneObserver& DroneObserver::operator=(DroneObserver&&) noexcept = default;

Push DroneObserver::push(const NavdataReading& packet, std::vector<OdometryState>& ready) {
  return state_->push(packet, ready);
}

Push DroneObserver::push(const DroneImu& imu, std::vector<OdometryState>& ready) {
  return state_->push(imu, ready);
}

Push DroneObserver::push(const DroneCommandReading& command) {
  return state_->push(command);
}

void DroneObserver::flush(std::vector<OdometryState>& ready) {
  state_->flush(ready);
}

const OdometryFaultCounts& DroneObserver::faults() const {
  return state_->faults();
}

}  // namespace ardrone_vslam
