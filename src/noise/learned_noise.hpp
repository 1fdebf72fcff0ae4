// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ardrone_vslam/odometry_config.hpp"
#include "noise/bias_level.hpp"
#include "noise/yaw_level.hpp"

namespace ardrone_vslam {

/// What is learned in flight of how the odometry errs.
struct LearnedNoise {
  BiasLevel bias;
  YawLevel yaw;

  explicit LearnedNoise(const OdometryNoiseConfig& config)
      : bias(config.velocity_bias_m_s), yaw(config) {}
  /// It is forgotten.
  void reset() {
    bias.reset();
    yaw.reset();
  }
};

}  // namespace ardrone_vslam
