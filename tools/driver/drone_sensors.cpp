// SPDX-License-Identifier: BSD-3-Clause
#include "driver/drone_sensors.hpp"

#include <algorithm>
#include <cmath>

namespace ardrone_vslam {
namespace {

constexpr std::uint64_t kSensorStream = 'S';
constexpr double kForceNoise_m_s2 = 0.1;
constexpr double kGyroNoise_rad_s = 0.005;
constexpr double kClockAtBegin_s = 90;  // the drone has been on for a while
constexpr double kBattery_s = 720;      // lasts for 12 minutes
constexpr double kHoverSpeed_m_s = 0.1;
constexpr double kAltitudeTime_s = 0.1;

/// Of the integral of an Ornstein-Uhlenbeck process of this sigma.
double integratedVariance(double sigma, double time_s, double t_s) {
  const double grown_s = t_s - time_s * -std::expm1(-t_s / time_s);
  return 2 * sigma * sigma * time_s * grown_s;
}

double square(double x) {
  return x * x;
}

/// What the profile's first part says about its errors; never zero, which would mean "unknown".
void setVariances(const OdometryProfile& profile, double t_s, double travelled_m,
                  DronePacket& packet) {
  constexpr double kLeast_m2 = 1e-6, kLeast_rad2 = 1e-6;
  constexpr double kNoiseRate_hz = 15;  // at which velocity_noise_m_s is meant
  const double velocity = square(profile.velocity_bias_m_s) +
                          square(profile.velocity_noise_m_s) * kPacketRate_hz / kNoiseRate_hz;
  const double position =
      integratedVariance(profile.velocity_bias_m_s, profile.velocity_bias_time_s, t_s) +
      square(profile.velocity_noise_m_s) * t_s / kNoiseRate_hz +
      square(profile.scale_sigma * travelled_m);
  const double noise = square(profile.attitude_noise_rad);
  const double yaw = noise + square(profile.yaw_walk_rad_per_sqrt_s) * t_s +
                     square(profile.yaw_walk_rad_per_sqrt_m) * travelled_m;
  packet.pose_variances.head<3>().setConstant(kLeast_m2 + position);
  packet.pose_variances.segment<2>(3).setConstant(kLeast_rad2 + noise +
                                                  square(profile.attitude_bias_rad));
  packet.pose_variances[5] = kLeast_rad2 + yaw;
  packet.twist_variances.head<3>().setConstant(kLeast_m2 + velocity);
  packet.twist_variances.tail<3>().setConstant(kLeast_rad2 + square(kGyroNoise_rad_s));
}

/// At the rate of the packets, and without the link, which is the drone's here.
OdometryProfile atTheDrone(OdometryProfile profile) {
  profile.rate_hz = kPacketRate_hz;
  profile.delay_s = profile.loss = 0;
  profile.bursts = false;
  return profile;
}

DronePacket::State stateOf(const FlightState& state) {
  return state.velocity_world_m_s.norm() < kHoverSpeed_m_s ? DronePacket::State::kHovering
                                                           : DronePacket::State::kFlying;
}

/// The earth's field, raw, in a world whose x axis points north; 66 degrees down.
Eigen::Vector3d magneticField(const Eigen::Matrix3d& R_world_base) {
  return R_world_base.transpose() * Eigen::Vector3d(200, 0, -450);
}

}  // namespace

DroneSensors::DroneSensors(const OdometryProfile& profile, std::uint64_t seed)
    : profile_(atTheDrone(profile)), drift_(profile_, seed), noise_(seed, kSensorStream) {}

double DroneSensors::fuseAltitude(const std::optional<double>& range_m, const DronePacket& packet) {
  altitude_m_ += (packet.R_odom_base * packet.velocity_base_m_s).z() * kPacketStep_s;
  if (!range_m) return altitude_m_;
  const double height_m = *range_m * packet.R_odom_base(2, 2);
  altitude_m_ = has_altitude_
                    ? altitude_m_ + (height_m - altitude_m_) * kPacketStep_s / kAltitudeTime_s
                    : height_m;
  has_altitude_ = true;
  return altitude_m_;
}

DronePacket DroneSensors::measure(const FlightState& state, const std::optional<double>& range_m) {
  const double t_s = static_cast<double>(count_) * kPacketStep_s;
  // Of whole nanoseconds, as stamps have them.
  const double since_first_s = std::round(t_s * 1e9) * 1e-9;
  const Eigen::Isometry3d T_odom_base = drift_.report(state.T_world_body, since_first_s);
  DronePacket packet;
  packet.clock_s = kClockAtBegin_s + t_s;
  packet.state = stateOf(state);
  packet.battery_percent = std::max(0.0, 100 * (1 - t_s / kBattery_s));
  packet.R_odom_base = T_odom_base.linear();
  if (count_ > 0) {
    const Eigen::Vector3d step_odom = T_odom_base.translation() - last_odom_m_;
    packet.velocity_base_m_s = packet.R_odom_base.transpose() * step_odom * kPacketRate_hz;
    travelled_m_ += step_odom.norm();
  }
  packet.altitude_m = fuseAltitude(range_m, packet);
  const double noise_share = profile_.isTruth() ? 0 : 1;
  packet.specific_force_base_m_s2 =
      state.specificForce_body_m_s2() + noise_share * kForceNoise_m_s2 * noise_.normal3();
  packet.angular_rate_base_rad_s =
      state.angular_rate_body_rad_s + noise_share * kGyroNoise_rad_s * noise_.normal3();
  packet.magnetic_field_base = magneticField(state.T_world_body.linear());
  setVariances(profile_, t_s, travelled_m_, packet);
  last_odom_m_ = T_odom_base.translation();
  ++count_;
  return packet;
}

}  // namespace ardrone_vslam
