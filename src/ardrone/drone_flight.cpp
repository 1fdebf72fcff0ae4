// SPDX-License-Identifier: BSD-3-Clause
#include "ardrone/drone_flight.hpp"

#include <algorithm>
#include <cmath>

#include "ardrone/commanded_flight.hpp"
#include "ardrone_vslam/rotation.hpp"
#include "linear/scalars.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kStep_s = 0.02;  // of the integration
constexpr double kHole_s = 0.1;   // in which nobody knows what was done
constexpr double kCommandsKept_s = 5;
constexpr double kCommandHolds_s = 0.5;  // the drone hovers when it is told nothing for longer
constexpr double kCommandTilt_deg =
    12;  // at a cmd_vel of 1: the driver's euler_angle_max as it comes
constexpr double kCommandTime_s = 0.12;  // in which roll and pitch follow, twice over
constexpr double kLongestHole_s = 1;     // as the OdometryAdapter's
constexpr double kLostSpeed_m_s = 1;     // that a drone may have flown at beyond it
constexpr double kAngularNoise_rad_s = 0.01;
// A heading that changes faster began anew: the drone itself turns by 6.1 rad/s at most.
constexpr double kYawJump_rad = 0.5;
constexpr double kFastestRotation_rad_s = 6;

/// Between two packets.
DroneMeasurement between(const DroneMeasurement& a, const DroneMeasurement& b, double share) {
  DroneMeasurement m = b;
  m.R_odom_base = a.R_odom_base *
                  rotationOf(share * rotationVectorOf(a.R_odom_base.transpose() * b.R_odom_base));
  m.force_base_m_s2 += (1 - share) * (a.force_base_m_s2 - b.force_base_m_s2);
  return m;
}

}  // namespace

void DroneFlight::reset() {
  commands_.clear();
  last_.reset();
  floor_.clear();
  yaw_offset_rad_ = 0;
}

void DroneFlight::hear(const DroneCommandReading& command) {
  if (!commands_.empty() && command.stamp_ns < commands_.back().stamp_ns) commands_.clear();
  commands_.push_back(command);
  while (seconds(command.stamp_ns - commands_.front().stamp_ns) > kCommandsKept_s)
    commands_.pop_front();
}

std::optional<OdometryState> DroneFlight::advance(const NavdataSample& sample) {
  NavdataReading packet = sample.packet;
  if (!last_) {
    filter_.begin(packet.measured);
    first_ns_ = packet.stamp_ns;
  } else {
    const double dt_s = seconds(packet.stamp_ns - last_->stamp_ns);
    if (dt_s <= 0) return std::nullopt;
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
  if (sample.angular_rate_base_rad_s) {
    state.twist_base.tail<3>() = *sample.angular_rate_base_rad_s;
    state.twist_covariance.diagonal().tail<3>().setConstant(squared(kAngularNoise_rad_s));
  }
  return state;
}

/// A drone that was switched on anew reports another yaw: odom stays where it was.
void DroneFlight::keepYaw(NavdataReading& packet, double dt_s) {
  Eigen::Matrix3d& R = packet.measured.R_odom_base;
  R = rotationAboutZ(yaw_offset_rad_) * R;
  const double rotation_rad =
      std::remainder(yawOf(R) - yawOf(last_->measured.R_odom_base), 2 * M_PI);
  if (std::abs(rotation_rad) <= kYawJump_rad + kFastestRotation_rad_s * dt_s) return;
  count(OdometryFault::kReset);
  yaw_offset_rad_ -= rotation_rad;
  R = rotationAboutZ(-rotation_rad) * R;
}

void DroneFlight::fly(const NavdataReading& packet, double dt_s) {
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
void DroneFlight::bridge(const NavdataReading& packet, double flown_s) {
  using Known = DroneFilter::Known;
  const std::int64_t oldest_ns = last_->stamp_ns - std::llround(kCommandHolds_s * 1e9);
  auto next = std::find_if(commands_.begin(), commands_.end(),
                           [&](const DroneCommandReading& c) { return c.stamp_ns >= oldest_ns; });
  const bool is_told = next != commands_.end() && next->stamp_ns < packet.stamp_ns;
  CommandedFlight commanded(last_->measured, radians(kCommandTilt_deg), kCommandTime_s);
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

void DroneFlight::useHeight(const NavdataReading& packet, double dt_s) {
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

}  // namespace ardrone_vslam
