// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/odometry_drift.hpp"

#include <cmath>

#include "simulation/random_source.hpp"

namespace ardrone_vslam {
namespace {

constexpr double kVelocityNoiseRate_hz = 15;  // at which velocity_noise_m_s is stated

/// One stream of random numbers for each cause, so that switching one off leaves the others alone.
enum Stream : std::uint64_t { kScale, kVelocity, kStep, kAttitude, kYaw, kYawScale = 6 };

/// Ornstein-Uhlenbeck process, discretised exactly and started in its stationary distribution.
class DriftingBias {
 public:
  DriftingBias(double sigma, double time_constant_s, double dt_s, const Eigen::Vector3d& draw)
      : value_(sigma * draw),
        keep_(std::exp(-dt_s / time_constant_s)),
        noise_(sigma * std::sqrt(1 - keep_ * keep_)) {}

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

double rotationAboutZ(const Eigen::Matrix3d& R_then_now) {
  const Eigen::AngleAxisd angle_axis(R_then_now);
  return angle_axis.angle() * angle_axis.axis().z();
}

/// True attitude -> reported attitude.
class AttitudeCorruption {
 public:
  AttitudeCorruption(const OdometryProfile& profile, double dt_s, std::uint64_t seed)
      : profile_(profile),
        dt_s_(dt_s),
        noise_(seed, kAttitude),
        yaw_noise_(seed, kYaw),
        yaw_scale_error_(profile.yaw_scale_sigma * RandomSource(seed, kYawScale).normal()),
        tilt_bias_(profile.attitude_bias_rad, profile.attitude_bias_time_s, dt_s, noise_.normal3()),
        walk_(Eigen::Quaterniond::Identity()) {}

  /// The error of a step of this length turns about the body's own z axis, which is up whatever the
  /// convention of the map is (a map of camera poses may have its y axis down).
  /// @param yaw_rad  what the body turned by in the step about that axis
  void advance(double step_m, double yaw_rad, const Eigen::Quaterniond& true_map_base) {
    const double variance =
        profile_.yaw_walk_rad_per_sqrt_m * profile_.yaw_walk_rad_per_sqrt_m * step_m +
        profile_.yaw_walk_rad_per_sqrt_s * profile_.yaw_walk_rad_per_sqrt_s * dt_s_;
    const Eigen::Vector3d rotation_rad(
        0, 0, std::sqrt(variance) * yaw_noise_.normal() + yaw_scale_error_ * yaw_rad);
    walk_ = (walk_ * true_map_base * fromRotationVector(rotation_rad) * true_map_base.conjugate())
                .normalized();
    tilt_bias_.advance(noise_.normal3());
  }

  void changeTo(const OdometryProfile& profile) {
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
  OdometryProfile profile_;
  double dt_s_;
  RandomSource noise_;
  RandomSource yaw_noise_;
  double yaw_scale_error_;
  DriftingBias tilt_bias_;   // rotation vector, body; z unused
  Eigen::Quaterniond walk_;  // in the map, left of the true attitude
};

/// True step in the body frame -> reported one.
class StepCorruption {
 public:
  StepCorruption(const OdometryProfile& profile, double dt_s, double scale_error,
                 std::uint64_t seed)
      : profile_(profile),
        dt_s_(dt_s),
        scale_(1 + scale_error),
        white_m_(profile.velocity_noise_m_s * dt_s / std::sqrt(dt_s * kVelocityNoiseRate_hz)),
        velocity_noise_(seed, kVelocity),
        step_noise_(seed, kStep),
        velocity_bias_(profile.velocity_bias_m_s, profile.velocity_bias_time_s, dt_s,
                       velocity_noise_.normal3()) {}

  void changeTo(const OdometryProfile& profile) {
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
  OdometryProfile profile_;
  double dt_s_;
  double scale_;
  double white_m_;
  RandomSource velocity_noise_;
  RandomSource step_noise_;
  DriftingBias velocity_bias_;  // body frame, m/s
};

}  // namespace

struct OdometryDrift::Noise {
  AttitudeCorruption attitude;
  StepCorruption steps;
};

OdometryDrift::OdometryDrift(const OdometryProfile& profile, std::uint64_t seed)
    : profile_(profile) {
  if (profile.isTruth()) return;
  const double dt_s = 1 / profile.rate_hz;
  scale_error_ = profile.scale_sigma * RandomSource(seed, kScale).normal();
  noise_ = std::make_unique<Noise>(Noise{AttitudeCorruption(profile, dt_s, seed),
                                         StepCorruption(profile, dt_s, scale_error_, seed)});
}

OdometryDrift::~OdometryDrift() = default;

void OdometryDrift::changeProfile(double since_first_s) {
  for (; next_ < profile_.later.size() && since_first_s >= profile_.later[next_].from_s; ++next_) {
    noise_->attitude.changeTo(profile_.later[next_]);
    noise_->steps.changeTo(profile_.later[next_]);
  }
}

Eigen::Isometry3d OdometryDrift::report(const Eigen::Isometry3d& T_map_base, double since_first_s) {
  if (!noise_) return T_map_base;
  changeProfile(since_first_s);
  const Eigen::Quaterniond q_map_base(T_map_base.linear());
  Eigen::Vector3d position = T_map_base.translation();
  if (has_last_) {
    const Eigen::Matrix3d R_last_map = T_map_last_.linear().transpose();
    const Eigen::Vector3d step_base =
        R_last_map * (T_map_base.translation() - T_map_last_.translation());
    position =
        T_odom_last_.translation() + T_odom_last_.linear() * noise_->steps.corrupt(step_base);
    noise_->attitude.advance(step_base.norm(), rotationAboutZ(R_last_map * T_map_base.linear()),
                             q_map_base);
  }
  has_last_ = true;
  T_map_last_ = T_map_base;
  T_odom_last_.linear() = noise_->attitude.report(q_map_base).toRotationMatrix();
  T_odom_last_.translation() = position;
  return T_odom_last_;
}

}  // namespace ardrone_vslam
