// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "configs/node_config.hpp"
#include "conversions/conversions.hpp"

namespace ardrone_vslam {

/// The frames of what odometry_fusion hears and says.
class FusionFrames {
 public:
  FusionFrames() = default;
  FusionFrames(const OdometryFusionNodeConfig& config, std::string tf_prefix);

  /// Odometry of this frame has come.
  void see(const std::string& odometry_child);
  /// What is wrong with those of a correction, and what helps; empty when nothing is.
  std::string faultOf(const PoseCorrection& correction) const;
  /// Base is empty until the first odometry; odom is not used.
  const Frames& frames() const { return frames_; }

 private:
  std::string tf_prefix_;
  std::string base_frame_;  // as configured; empty: the odometry's
  Frames frames_;
};

}  // namespace ardrone_vslam
