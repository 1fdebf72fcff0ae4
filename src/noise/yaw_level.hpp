// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ardrone_vslam/odometry_config.hpp"
#include "ardrone_vslam/setup_watch.hpp"

namespace ardrone_vslam {

/// How fast the odometry's yaw drifts: begins as configured and is learned from how much the camera
/// turns otherwise between two images. For each of some factors on the configured walk, 1 and
/// larger, the likelihood of what was seen over the last minute is kept. The most probable one is
/// in force, but none below 2: images err by more from one to the next than a good yaw, and a lens
/// or a clock that is not quite as told looks like a worse one. The filter's own corrections would
/// not do: its gates leave out what contradicts a yaw that it is too sure of.
class YawLevel {
 public:
  /// A walk of zero stays zero.
  explicit YawLevel(const OdometryNoiseConfig& config) : config_(config) {}

  /// One pair of images; nothing is learned of the same one again, nor while a set-up is wrong.
  void learn(const SetupFinding& finding);
  /// What was learned is forgotten.
  void reset() { *this = YawLevel(config_); }

  /// Variance by which yaw drifts over such a way.
  double walk_rad2(double time_s, double displacement_m) const {
    return variance_factor_ * configuredWalk_rad2(time_s, displacement_m);
  }
  /// Of the walk's standard deviation, over what is configured.
  double factor() const { return std::sqrt(variance_factor_); }

 private:
  static constexpr std::size_t kFactors = 21;

  double configuredWalk_rad2(double time_s, double displacement_m) const;

  OdometryNoiseConfig config_;
  double variance_factor_ = 1;
  std::int64_t learned_ns_ = 0;
  std::array<double, kFactors> log_likelihood_{};
};

}  // namespace ardrone_vslam
