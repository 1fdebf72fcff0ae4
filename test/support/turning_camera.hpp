// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ardrone_vslam/features.hpp"
#include "ardrone_vslam/odometry_buffer.hpp"
#include "simulation/random_source.hpp"
#include "support/point_world.hpp"

namespace ardrone_vslam::test {

/// A drone that sways and yaws about at frequencies and phases drawn from the seed.
class Swaying {
 public:
  explicit Swaying(std::uint64_t seed, double rotation_rad = 0.15, double displacement_m = 0.4) {
    RandomSource random(seed, 5);
    for (int axis = 0; axis < 3; ++axis) {
      rotations_.push_back({rotation_rad * (axis == 2 ? 3 : 1), random.uniform(0.3, 0.8),
                            random.uniform(0, 2 * M_PI)});
      displacements_.push_back(
          {displacement_m, random.uniform(0.1, 0.3), random.uniform(0, 2 * M_PI)});
    }
  }

  Eigen::Isometry3d T_map_base(double t_s) const {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = (Eigen::AngleAxisd(at(rotations_[2], t_s), Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(at(rotations_[1], t_s), Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(at(rotations_[0], t_s), Eigen::Vector3d::UnitX()))
                     .toRotationMatrix();
    for (int axis = 0; axis < 3; ++axis)
      T.translation()[axis] = at(displacements_[static_cast<std::size_t>(axis)], t_s);
    return T;
  }

 private:
  struct Wave {
    double amplitude;
    double frequency_hz;
    double phase_rad;
  };
  static double at(const Wave& wave, double t_s) {
    return wave.amplitude * std::sin(2 * M_PI * wave.frequency_hz * t_s + wave.phase_rad);
  }

  std::vector<Wave> rotations_;
  std::vector<Wave> displacements_;
};

constexpr std::int64_t kSwayBegin_ns = 10'000'000'000;

inline std::int64_t swayStamp_ns(double t_s) {
  return kSwayBegin_ns + std::llround(t_s * 1e9);
}

struct AttitudeErrors {
  double noise_rad = 0;
  double yaw_drift_rad_s = 0;
};

/// Odometry of a flight from t = -1 s to its end and a second more.
template <class Flight>
OdometryBuffer swayOdometry(const Flight& flight, double duration_s, double rate_hz,
                            const AttitudeErrors& errors, std::uint64_t seed) {
  OdometryBufferConfig config;
  config.buffer_s = 600;
  OdometryBuffer buffer(config);
  RandomSource random(seed, 6);
  for (double t_s = -1; t_s < duration_s + 1; t_s += 1 / rate_hz) {
    OdometryState state;
    state.stamp_ns = swayStamp_ns(t_s);
    state.T_odom_base = flight.T_map_base(t_s);
    const Eigen::Vector3d noise_rad = errors.noise_rad * random.normal3();
    state.T_odom_base.prerotate(
        Eigen::AngleAxisd(errors.yaw_drift_rad_s * t_s, Eigen::Vector3d::UnitZ()));
    if (noise_rad.norm() > 0)
      state.T_odom_base.rotate(Eigen::AngleAxisd(noise_rad.norm(), noise_rad.normalized()));
    buffer.push(state);
  }
  return buffer;
}

/// What a forward camera of 640x360 pixels sees of points about it; exposed at `t_s`, stamped with
/// `stamp_ns`.
class PointCamera {
 public:
  explicit PointCamera(std::uint64_t seed, double corner_px = 0.5)
      : random_(seed, 7), corner_rad_(corner_px / kFocal_px) {
    for (int i = 0; i < 900; ++i) {
      const Eigen::Vector3d direction = random_.normal3().normalized();
      points_map_m_.push_back(random_.uniform(2, 6) * direction);
    }
  }

  ImageFeatures look(const Eigen::Isometry3d& T_map_base, std::int64_t stamp_ns) {
    ImageFeatures features;
    features.stamp_ns = stamp_ns;
    features.width_px = 640;
    features.height_px = 360;
    features.focal_length_px = static_cast<float>(kFocal_px);
    const Eigen::Isometry3d T_cam_map = (T_map_base * forwardExtrinsics()).inverse();
    for (std::size_t i = 0; i < points_map_m_.size(); ++i) {
      const Eigen::Vector3d seen = T_cam_map * points_map_m_[i];
      if (seen.z() < 0.5 || std::abs(seen.x()) > 0.56 * seen.z() ||
          std::abs(seen.y()) > 0.32 * seen.z())
        continue;
      const Eigen::Vector3d bearing =
          (seen.normalized() + corner_rad_ * random_.normal3()).normalized();
      features.pixel_px.emplace_back(Eigen::Vector2f::Zero());  // not looked at
      features.bearing_cam.push_back(bearing.cast<float>());
      features.track_id.push_back(static_cast<std::uint32_t>(i + 1));
    }
    return features;
  }

 private:
  static constexpr double kFocal_px = 570;
  RandomSource random_;
  double corner_rad_;
  std::vector<Eigen::Vector3d> points_map_m_;
};

}  // namespace ardrone_vslam::test
