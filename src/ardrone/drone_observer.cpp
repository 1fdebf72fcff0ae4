// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone_vslam/drone_observer.hpp"

#include <cmath>

#include "ardrone/drone_flight.hpp"
#include "ardrone/navdata_sync.hpp"

namespace ardrone_vslam {
namespace {

using Push = OdometryBuffer::Push;

constexpr double kLargestForce_m_s2 = 1e3;
constexpr double kHighest_m = 1e4;

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
  if (!imu.angular_rate_base_rad_s.allFinite() || !imu.force_base_m_s2.allFinite()) {
    return Push::kNotFinite;
  }
  const bool is_in_range = imu.angular_rate_base_rad_s.cwiseAbs().maxCoeff() <= kFastestOdometry &&
                           imu.force_base_m_s2.cwiseAbs().maxCoeff() <= kLargestForce_m_s2;
  return is_in_range ? Push::kAccepted : Push::kOutOfRange;
}

}  // namespace

/// What waits, and what flies; never moved, as the flight counts into it.
class DroneObserver::State {
 public:
  State() : flight_(faults_) {}

  Push push(const NavdataReading& packet, std::vector<OdometryState>& ready) {
    using Added = NavdataSync::Added;
    const Push answer = check(packet.measured);
    if (answer != Push::kAccepted) return answer;
    const Added added = sync_.add(packet);
    if (added == Added::kBackward) return Push::kBackwardStamp;
    if (added == Added::kRestart) {
      count(OdometryFault::kRestart);
      flight_.reset();
    }
    release(ready);
    return Push::kAccepted;
  }
  Push push(const DroneImu& imu, std::vector<OdometryState>& ready) {
    const Push answer = check(imu);
    if (answer != Push::kAccepted) return answer;
    if (!sync_.add(imu)) return Push::kBackwardStamp;
    release(ready);
    return Push::kAccepted;
  }
  Push push(const DroneCommandReading& command) {
    if (!command.tilt.allFinite()) return Push::kNotFinite;
    flight_.hear(command);
    return Push::kAccepted;
  }
  void flush(std::vector<OdometryState>& ready) {
    while (sync_.hasMore()) releaseFirst(ready);
  }
  const OdometryFaultCounts& faults() const { return faults_; }

 private:
  void count(OdometryFault fault) { ++faults_[static_cast<std::size_t>(fault)]; }
  void release(std::vector<OdometryState>& ready) {
    while (sync_.isFirstReady()) releaseFirst(ready);
  }
  /// All packets of the oldest stamp.
  void releaseFirst(std::vector<OdometryState>& ready) {
    const std::vector<NavdataSample> samples = sync_.takeFirst();
    if (samples.size() > 1) count(OdometryFault::kBurst);
    for (const NavdataSample& sample : samples) {
      if (const auto state = flight_.advance(sample)) ready.push_back(*state);
    }
  }

  OdometryFaultCounts faults_{};
  NavdataSync sync_;
  DroneFlight flight_;
};

DroneObserver::DroneObserver() : state_(std::make_unique<State>()) {}

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
