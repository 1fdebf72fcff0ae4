// SPDX-License-Identifier: BSD-3-Clause
#include "observer_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kVelocityNoiseRate_hz = 15;  // at which velocity_noise_m_s is stated
constexpr std::size_t kBurstLength = 6;       // packets that the driver hands over together
constexpr double kBurstChance = 1.0 / 7;      // at each packet outside one: half come in bursts

/// One stream of random numbers for each cause, so that switching one off leaves the others alone.
enum Stream : std::uint64_t { kScale, kVelocity, kStep, kAttitude, kYaw, kTransport };

/// Ornstein-Uhlenbeck process, discretised exactly and started in its stationary distribution.
class DriftingBias {
 public:
  DriftingBias(double deviation, double time_constant_s, double dt_s, const Eigen::Vector3d& draw)
      : value_(deviation * draw),
        keep_(std::exp(-dt_s / time_constant_s)),
        noise_(deviation * std::sqrt(1 - keep_ * keep_)) {}

  void advance(const Eigen::Vector3d& draw) { value_ = keep_ * value_ + noise_ * draw; }
  const Eigen::Vector3d& value() const { return value_; }

 private:
  Eigen::Vector3d value_;
  double keep_;
  double noise_;
};

Eigen::Quaterniond fromRotationVector(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, v / angle));
}

/// True attitude -> reported attitude.
class AttitudeCorruption {
 public:
  AttitudeCorruption(const ObserverProfile& profile, double dt_s, std::uint64_t seed)
      : profile_(profile),
        dt_s_(dt_s),
        noise_(seed, kAttitude),
        yaw_noise_(seed, kYaw),
        tilt_bias_(profile.attitude_bias_rad, profile.attitude_bias_time_s, dt_s, noise_.normal3()),
        walk_(Eigen::Quaterniond::Identity()) {}

  /// The walk over a step of this length turns about the body's own z axis, which is up whatever
  /// the convention of the map is (a map of camera poses may have its y axis down).
  void advance(double step_m, const Eigen::Quaterniond& true_map_base) {
    const double variance =
        profile_.yaw_walk_rad_per_sqrt_m * profile_.yaw_walk_rad_per_sqrt_m * step_m +
        profile_.yaw_walk_rad_per_sqrt_s * profile_.yaw_walk_rad_per_sqrt_s * dt_s_;
    const Eigen::Vector3d turn(0, 0, std::sqrt(variance) * yaw_noise_.normal());
    walk_ =
        (walk_ * true_map_base * fromRotationVector(turn) * true_map_base.conjugate()).normalized();
    tilt_bias_.advance(noise_.normal3());
  }

  void changeTo(const ObserverProfile& profile) {
    profile_ = profile;
    tilt_bias_ = DriftingBias(profile.attitude_bias_rad, profile.attitude_bias_time_s, dt_s_,
                              noise_.normal3());
  }

  /// Draws new white noise at each call.
  Eigen::Quaterniond report(const Eigen::Quaterniond& true_map_base) {
    Eigen::Vector3d error = profile_.attitude_noise_rad * noise_.normal3();
    error.head<2>() += tilt_bias_.value().head<2>();
    return (walk_ * true_map_base * fromRotationVector(error)).normalized();
  }

 private:
  ObserverProfile profile_;
  double dt_s_;
  RandomSource noise_;
  RandomSource yaw_noise_;
  DriftingBias tilt_bias_;   // rotation vector, body; z unused
  Eigen::Quaterniond walk_;  // in the map, left of the true attitude
};

/// True step in the body frame -> reported one.
class StepCorruption {
 public:
  StepCorruption(const ObserverProfile& profile, double dt_s, double scale_error,
                 std::uint64_t seed)
      : profile_(profile),
        dt_s_(dt_s),
        scale_(1 + scale_error),
        white_m_(profile.velocity_noise_m_s * dt_s / std::sqrt(dt_s * kVelocityNoiseRate_hz)),
        velocity_noise_(seed, kVelocity),
        step_noise_(seed, kStep),
        velocity_bias_(profile.velocity_bias_m_s, profile.velocity_bias_time_s, dt_s,
                       velocity_noise_.normal3()) {}

  void changeTo(const ObserverProfile& profile) {
    profile_ = profile;
    white_m_ = profile.velocity_noise_m_s * dt_s_ / std::sqrt(dt_s_ * kVelocityNoiseRate_hz);
    velocity_bias_ = DriftingBias(profile.velocity_bias_m_s, profile.velocity_bias_time_s, dt_s_,
                                  velocity_noise_.normal3());
  }

  Eigen::Vector3d corrupt(const Eigen::Vector3d& step_base) {
    Eigen::Vector3d result = scale_ * step_base;
    result += profile_.step_noise * step_base.norm() * step_noise_.normal3();
    result += velocity_bias_.value() * dt_s_ + white_m_ * velocity_noise_.normal3();
    velocity_bias_.advance(velocity_noise_.normal3());
    return result;
  }

 private:
  ObserverProfile profile_;
  double dt_s_;
  double scale_;
  double white_m_;
  RandomSource velocity_noise_;
  RandomSource step_noise_;
  DriftingBias velocity_bias_;  // body frame, m/s
};

std::vector<std::int64_t> measurementTimes(const Trajectory& truth, const ObserverProfile& profile,
                                           std::int64_t delay_ns) {
  const std::int64_t first_ns = truth.poses().front().stamp_ns - delay_ns;
  const std::int64_t last_ns = truth.poses().back().stamp_ns - delay_ns;
  std::vector<std::int64_t> times_ns{first_ns};
  while (times_ns.back() < last_ns) {
    const auto k = static_cast<double>(times_ns.size());
    times_ns.push_back(first_ns + std::llround(k * 1e9 / profile.rate_hz));
  }
  return times_ns;
}

std::vector<ObserverState> integrate(const Trajectory& truth,
                                     const std::vector<std::int64_t>& times_ns,
                                     const ObserverProfile& profile, double scale_error,
                                     std::uint64_t seed) {
  const double dt_s = 1 / profile.rate_hz;
  AttitudeCorruption attitude(profile, dt_s, seed);
  StepCorruption steps(profile, dt_s, scale_error, seed);
  std::vector<ObserverState> states;
  states.reserve(times_ns.size());
  Eigen::Isometry3d T_map_base = truth.at(times_ns.front());
  Eigen::Vector3d reported_position = T_map_base.translation();
  auto later = profile.later.begin();
  for (const std::int64_t time_ns : times_ns) {
    for (; later != profile.later.end() &&
           static_cast<double>(time_ns - times_ns.front()) * 1e-9 >= later->from_s;
         ++later) {
      attitude.changeTo(*later);
      steps.changeTo(*later);
    }
    const Eigen::Isometry3d next = truth.at(time_ns);
    const Eigen::Quaterniond q_next(next.linear());
    if (!states.empty()) {
      const Eigen::Vector3d step_base =
          T_map_base.linear().transpose() * (next.translation() - T_map_base.translation());
      reported_position += states.back().T_odom_base.linear() * steps.corrupt(step_base);
      attitude.advance(step_base.norm(), q_next);
    }
    ObserverState state;
    state.stamp_ns = time_ns;
    state.T_odom_base.linear() = attitude.report(q_next).toRotationMatrix();
    state.T_odom_base.translation() = reported_position;
    states.push_back(state);
    T_map_base = next;
  }
  return states;
}

/// What the way from the drone does: stamps of reception, losses, bursts. The first and the last
/// state arrive always, so that the stamps cover the images.
std::vector<ObserverState> transport(const std::vector<ObserverState>& measured,
                                     const ObserverProfile& profile, std::int64_t delay_ns,
                                     std::uint64_t seed) {
  RandomSource random(seed, kTransport);
  std::vector<ObserverState> received;
  received.reserve(measured.size());
  std::size_t burst_end = 0;  // one past the last state of the present burst
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (profile.bursts && i >= burst_end && i > 0 && random.chance(kBurstChance)) {
      burst_end = std::min(i + kBurstLength, measured.size());
    }
    const bool lost = random.chance(profile.loss) && i > 0 && i + 1 < measured.size();
    if (lost) continue;
    received.push_back(measured[i]);
    const std::size_t handed_over = i < burst_end ? burst_end - 1 : i;
    received.back().stamp_ns = measured[handed_over].stamp_ns + delay_ns;
  }
  return received;
}

}  // namespace

ObserverRun simulateObserver(const Trajectory& truth, const ObserverProfile& profile,
                             std::uint64_t seed) {
  assert(!truth.empty() && "an observer needs a true trajectory");
  const std::int64_t delay_ns = std::llround(profile.delay_s * 1e9);
  const auto times_ns = measurementTimes(truth, profile, delay_ns);
  ObserverRun run;
  if (profile.isTruth()) {
    for (const std::int64_t time_ns : times_ns) {
      run.states.push_back({time_ns, truth.at(time_ns), Matrix6d::Zero()});
    }
    return run;
  }
  run.scale_error = profile.scale_deviation * RandomSource(seed, kScale).normal();
  run.states = transport(integrate(truth, times_ns, profile, run.scale_error, seed), profile,
                         delay_ns, seed);
  return run;
}

}  // namespace ardrone_vslam
