// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include "ardrone_vslam/delayed_fusion.hpp"
#include "conversions/conversions.hpp"

namespace ardrone_vslam {

/// What odometry_fusion publishes beside its status.
class FusionOutputs {
 public:
  void advertise(ros::NodeHandle& nh);
  /// The newest state, at the odometry's rate.
  void publishLive(const DelayedFusion& fusion, const Frames& frames);
  /// The path since the last correction, to those who look.
  void publishRepropagated(const DelayedFusion& fusion, const Frames& frames);

 private:
  ros::Publisher live_;
  ros::Publisher repropagated_;
};

}  // namespace ardrone_vslam
