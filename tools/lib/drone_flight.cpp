// SPDX-License-Identifier: BSD-3-Clause
#include "drone_flight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kStep_s = 1 / kPacketRate_hz;
constexpr std::uint64_t kSensorStream = 'S';
constexpr double kForceNoise_m_s2 = 0.1;
constexpr double kGyroNoise_rad_s = 0.005;
constexpr double kClockAtBegin_s = 90;  // the drone has been on for a while
constexpr double kBattery_s = 720;      // lasts for 12 minutes
constexpr double kHoverSpeed_m_s = 0.1;

/// Height above what is below: the sonar, and between its echoes the vertical velocity.
class AltitudeFusion {
 public:
  double update(const std::optional<double>& range_m, const Eigen::Matrix3d& R_odom_base,
                const Eigen::Vector3d& velocity_base_m_s) {
    constexpr double kTime_s = 0.1;
    altitude_m_ += (R_odom_base * velocity_base_m_s).z() * kStep_s;
    if (!range_m) return altitude_m_;
    const double height_m = *range_m * R_odom_base(2, 2);
    altitude_m_ = started_ ? altitude_m_ + (height_m - altitude_m_) * kStep_s / kTime_s : height_m;
    started_ = true;
    return altitude_m_;
  }

 private:
  double altitude_m_ = 0;
  bool started_ = false;
};

/// Of the integral of an Ornstein-Uhlenbeck process of this deviation.
double integratedVariance(double deviation, double time_s, double t_s) {
  const double grown_s = t_s - time_s * -std::expm1(-t_s / time_s);
  return 2 * deviation * deviation * time_s * grown_s;
}

double square(double x) {
  return x * x;
}

/// What the profile's first part says about its errors; never zero, which would mean "unknown".
void setVariances(const ObserverProfile& profile, double t_s, double way_m, DronePacket& packet) {
  constexpr double kLeast_m2 = 1e-6, kLeast_rad2 = 1e-6;
  constexpr double kNoiseRate_hz = 15;  // at which velocity_noise_m_s is meant
  const double velocity = square(profile.velocity_bias_m_s) +
                          square(profile.velocity_noise_m_s) * kPacketRate_hz / kNoiseRate_hz;
  const double position =
      integratedVariance(profile.velocity_bias_m_s, profile.velocity_bias_time_s, t_s) +
      square(profile.velocity_noise_m_s) * t_s / kNoiseRate_hz +
      square(profile.scale_deviation * way_m);
  const double noise = square(profile.attitude_noise_rad);
  const double yaw = noise + square(profile.yaw_walk_rad_per_sqrt_s) * t_s +
                     square(profile.yaw_walk_rad_per_sqrt_m) * way_m;
  packet.pose_variances.head<3>().setConstant(kLeast_m2 + position);
  packet.pose_variances.segment<2>(3).setConstant(kLeast_rad2 + noise +
                                                  square(profile.attitude_bias_rad));
  packet.pose_variances[5] = kLeast_rad2 + yaw;
  packet.twist_variances.head<3>().setConstant(kLeast_m2 + velocity);
  packet.twist_variances.tail<3>().setConstant(kLeast_rad2 + square(kGyroNoise_rad_s));
}

ObserverRun driftingOdometry(const Trajectory& truth, ObserverProfile& profile,
                             std::uint64_t seed) {
  profile.rate_hz = kPacketRate_hz;
  profile.delay_s = profile.loss = 0;
  profile.bursts = false;
  return simulateObserver(truth, profile, seed);
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

DroneFlight flyDrone(const Flight& flight, const World& world, double duration_s,
                     std::int64_t first_ns, ObserverProfile profile, std::uint64_t seed) {
  DroneFlight result;
  const auto count = static_cast<std::size_t>(std::ceil(duration_s * kPacketRate_hz)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    result.truth.append({first_ns + std::llround(t_s * 1e9), flight.pose(t_s)});
  }
  const ObserverRun odometry = driftingOdometry(result.truth, profile, seed);
  result.scale_error = odometry.scale_error;
  RandomSource noise(seed, kSensorStream);
  const double noise_share = profile.isTruth() ? 0 : 1;
  AltitudeFusion altitude;
  double way_m = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    const FlightState state = flight.state(t_s);
    const Eigen::Isometry3d& T_odom_base = odometry.states[i].T_odom_base;
    DronePacket packet;
    packet.clock_s = kClockAtBegin_s + t_s;
    packet.state = stateOf(state);
    packet.battery_percent = std::max(0.0, 100 * (1 - t_s / kBattery_s));
    packet.R_odom_base = T_odom_base.linear();
    if (i > 0) {
      const Eigen::Vector3d step_odom =
          T_odom_base.translation() - odometry.states[i - 1].T_odom_base.translation();
      packet.velocity_base_m_s = packet.R_odom_base.transpose() * step_odom * kPacketRate_hz;
      way_m += step_odom.norm();
    }
    packet.altitude_m = altitude.update(world.rangeBelow_m(state.T_world_body, t_s),
                                        packet.R_odom_base, packet.velocity_base_m_s);
    packet.specific_force_base_m_s2 =
        state.specificForce_body_m_s2() + noise_share * kForceNoise_m_s2 * noise.normal3();
    packet.turn_rate_base_rad_s =
        state.turn_rate_body_rad_s + noise_share * kGyroNoise_rad_s * noise.normal3();
    packet.magnetic_field_base = magneticField(state.T_world_body.linear());
    setVariances(profile, t_s, way_m, packet);
    result.packets.push_back(packet);
  }
  return result;
}

}  // namespace ardrone_vslam
